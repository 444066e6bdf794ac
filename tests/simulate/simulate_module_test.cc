#include "lyrefit/simulate/simulate_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/read/read_pan.h"
#include "read/pan_text.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ReadForSimulation, GivesTheCurveOfAModuleUnderTheStatedConditions) {
  const TempFolder folder;
  ConditionOptions stated;
  stated.irradiance_W_m2 = 800;
  stated.temperature_C = 45;
  for (const PanLines& lines : {kSiliconPan, kThinPan}) {
    const std::string file = folder.Write("m.PAN", lines.Text());
    auto device = ReadForSimulation(file, "", stated);
    ASSERT_TRUE(device) << device.error().ToString();
    EXPECT_EQ(device->options.conditions.irradiance_W_m2, 800);
    EXPECT_NEAR(device->options.conditions.cell_temperature_K, 318.15, 1e-12);
    device->options.voltage_V = {0, 20, 30};
    const auto curve = Simulate(device->options);
    ASSERT_TRUE(curve) << curve.error().ToString();
    const auto module = ReadPanParameters(lines.Text(), file);
    const auto at = TranslateTo(module->translation, module->shared, 800, 318.15);
    for (int k = 0; k < 3; ++k) {
      const double v = curve->voltage_V[k];
      EXPECT_NEAR(curve->current_A[k],
                  SolveOperatingPoint(at.device, at.parameters.data(), v).current_A, 1e-12);
    }
  }
}

// pvlib's fit_desoto states no number of cells: any gives the same curve.
TEST(ReadForSimulation, TakesAModuleWithoutANumberOfCells) {
  const TempFolder folder;
  const std::string file = folder.Write(
      "m.json", R"({"alpha_sc":0.005,"a_ref":1.5,"I_L_ref":9,"I_o_ref":1e-10,"R_sh_ref":400,
                    "R_s":0.2})");
  ConditionOptions stated;
  const auto one = ReadForSimulation(file, "", stated);
  stated.cells = 60;
  const auto sixty = ReadForSimulation(file, "", stated);
  ASSERT_TRUE(one && sixty) << MessageOf(one) << MessageOf(sixty);
  EXPECT_EQ(sixty->options.conditions.cells_in_series, 60);
  EXPECT_NEAR(sixty->options.parameters.at("n1"), one->options.parameters.at("n1") / 60, 1e-12);
}

constexpr char kFamilyReport[] =
    R"({"family":"desoto","model":"sd","shunt":"inverse","recombination":false,
        "cells_in_series":36,"constants":"codata","rmse":{"refined":{"solved_current_A":0.01}},
        "parameters":{"I_L_ref":{"symbol":"Iph","refined":2.7},
                      "I_o_ref":{"symbol":"Is1","refined":1e-8},
                      "n":{"symbol":"n1","refined":1.25},"R_s":{"symbol":"Rs","refined":0.2},
                      "R_sh_ref":{"symbol":"Rsh","refined":null},
                      "alpha_sc":{"symbol":"alpha","refined":0.001},
                      "EgRef":{"symbol":"Eg","refined":1.121},
                      "dEgdT":{"symbol":"dEg","refined":-0.0002677}},
        "curves":[{"id":"a","role":"fitted"},{"id":"b","role":"fitted"}]})";

TEST(ReadForSimulation, TakesTheLawOfAFamilyAtStatedConditions) {
  const TempFolder folder;
  const std::string file = folder.Write("family.json", kFamilyReport);
  ConditionOptions stated;
  stated.irradiance_W_m2 = 800;
  EXPECT_THAT(MessageOf(ReadForSimulation(file, "", stated)),
              AllOf(HasSubstr("choose one of a, b"), HasSubstr("--temperature-C")));
  stated.temperature_C = 45;
  const auto device = ReadForSimulation(file, "", stated);
  ASSERT_TRUE(device) << device.error().ToString();
  TranslationSpec spec;
  spec.cells_in_series = 36;
  const std::vector<double> shared = {2.7, 1e-8, 1.25, 0.2, kInfinity, 0.001, 1.121, -0.0002677};
  const auto at = TranslateTo(*MakeTranslation(spec), shared, 800, 318.15);
  for (int i = 0; i < at.device.size(); ++i) {
    EXPECT_EQ(device->options.parameters.at(at.device.parameters[i].symbol), at.parameters[i]);
  }
  EXPECT_EQ(device->options.conditions.cells_in_series, 36);
  EXPECT_TRUE(Simulate(device->options));
  // A chosen curve is that curve, which this report does not hold in full.
  EXPECT_FALSE(ReadForSimulation(file, "a", stated));
}

TEST(ReadForSimulation, RefusesWhatTheModuleIsNot) {
  const TempFolder folder;
  const std::string file = folder.Write("m.PAN", kSiliconPan.Text());
  ConditionOptions stated;
  EXPECT_THAT(MessageOf(ReadForSimulation(file, "b", stated)), HasSubstr("no curve b"));
  stated.irradiance_W_m2 = 0;
  EXPECT_THAT(MessageOf(ReadForSimulation(file, "", stated)), HasSubstr("above 0 W/m2"));
  stated.irradiance_W_m2 = 800;
  stated.cells = 72;
  EXPECT_THAT(MessageOf(ReadForSimulation(file, "", stated)),
              HasSubstr("expected the 60 cells in series of the module m.PAN, found 72"));
  ConditionOptions dark;
  auto device = ReadForSimulation(folder.Write("t.PAN", kThinPan.Text()), "", dark);
  device->options.with.push_back(*ReadEffectUse("shading:d=0.3,w=0.5"));
  EXPECT_THAT(MessageOf(Simulate(device->options)), HasSubstr("recombination loss"));
}

}  // namespace
}  // namespace lyrefit
