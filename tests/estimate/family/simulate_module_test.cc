#include "lyrefit/estimate/family/simulate_module.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "estimate/family/pan_text.h"
#include "lyrefit/estimate/family/read_pan.h"
#include "lyrefit/model/current.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

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
