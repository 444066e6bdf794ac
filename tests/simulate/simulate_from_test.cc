#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lyrefit/base/version.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "lyrefit/simulate/simulate_from.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::nlohmann::json;
using ::testing::HasSubstr;

// A minimal report of two curves with one law.
json Shared() {
  const auto value = [](const char* symbol, double refined) {
    return json{{"symbol", symbol}, {"refined", refined}};
  };
  const auto curve = [](const char* id, double irradiance, double temperature_C) {
    return json{{"id", id},
                {"irradiance_Wm2", irradiance},
                {"cell_temperature_C", temperature_C},
                {"voltage_V", {0.0, 10.0, 20.0}},
                {"current_A", {4.0, 3.9, 1.0}}};
  };
  return {{"lyrefit_version", Version()},
          {"model", "sd"},
          {"constants", "codata"},
          {"causes", {"sensor_offset"}},
          {"rmse", {{"refined", {{"solved_current_A", 0.001}}}}},
          {"parameters",
           {{"I_L_ref", value("Iph", 4)},
            {"I_o_ref", value("Is1", 2e-8)},
            {"n", value("n1", 1.2)},
            {"R_s", value("Rs", 0.25)},
            {"R_sh_ref", {{"symbol", "Rsh"}, {"refined", nullptr}}},
            {"alpha_sc", value("alpha", 0.002)},
            {"EgRef", value("Eg", 1.121)},
            {"dEgdT", value("dEg", -2.677e-4)},
            {"sensor_offset.c", {{"effect", "sensor_offset"}, {"symbol", "c"}, {"refined", 25}}}}},
          {"law",
           {{"effects", {"sensor_offset"}},
            {"cells_in_series", 36},
            {"shunt", "inverse"},
            {"bandgap_slope_per_K", -2.677e-4},
            {"reference_temperature_C", 25},
            {"curves", {curve("a", 1000, 35), curve("b", 500, 25)}}}}};
}

Expected<IvCurve> SimulateOf(const json& report, const std::string& curve) {
  const TempFolder folder;
  const auto options = ReadFitForSimulation(folder.Write("family.json", report.dump()), curve);
  if (!options) return tl::unexpected(options.error());
  return Simulate(*options);
}

TEST(ReadFitForSimulation, FindsACurveOfManyUnderItsOwnConditions) {
  const auto a = SimulateOf(Shared(), "a"), b = SimulateOf(Shared(), "b");
  ASSERT_TRUE(a) << a.error().ToString();
  ASSERT_TRUE(b) << b.error().ToString();
  EXPECT_NEAR(a->current_A[0], 1.025 * (4 + 0.002 * 10), 1e-5);
  EXPECT_NEAR(b->current_A[0], 0.525 * 4, 1e-5);
  EXPECT_EQ(b->conditions.irradiance_W_m2, 500);
  EXPECT_EQ(b->voltage_V, (std::vector<double>{0, 10, 20}));
}

TEST(ReadFitForSimulation, ACurveOfManyMayStandUnderOtherConditions) {
  const TempFolder folder;
  auto options = ReadFitForSimulation(folder.Write("family.json", Shared().dump()), "b");
  ASSERT_TRUE(options) << options.error().ToString();
  options->conditions.irradiance_W_m2 = 800;
  options->voltage_V = {0, 5};
  const auto curve = Simulate(*options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  EXPECT_NEAR(curve->current_A[0], 0.825 * 4, 1e-5);
  EXPECT_EQ(curve->size(), 2U);
}

TEST(ReadFitForSimulation, SaysWhatIsWrongWithAReportOfMany) {
  const auto error = [](const json& report, const std::string& curve) {
    const auto made = SimulateOf(report, curve);
    return made ? "no error" : made.error().ToString();
  };
  EXPECT_THAT(error(Shared(), ""), HasSubstr("a report of 2 curves: choose one of a, b"));
  EXPECT_THAT(error(Shared(), "c"), HasSubstr("there is no curve c, expected one of a, b"));
  json report = Shared();
  report["lyrefit_version"] = "0.0.1";
  EXPECT_THAT(error(report, "a"), HasSubstr("written by lyrefit 0.0.1"));
  // The names of a major version stay: a later minor version reads this report, the next major one does not.
  report["lyrefit_version"] = "1.999.0";
  EXPECT_EQ(error(report, "a"), "no error");
  report["lyrefit_version"] = "10.0.0";
  EXPECT_THAT(error(report, "a"), HasSubstr("written by lyrefit 10.0.0"));
  report = Shared();
  report["causes"] = {"nonsense"};
  EXPECT_THAT(error(report, "a"), HasSubstr("there is no effect \"nonsense\""));
  report = Shared();
  report["law"]["curves"][1]["current_A"] = {1.0};
  EXPECT_THAT(error(report, "a"), HasSubstr("family.json"));
  report = Shared();
  report["parameters"].erase("sensor_offset.c");
  report["parameters"]["sensor_offset_irradiance_offset"] = {{"symbol", "sensor_offset.c"},
                                                             {"refined", 25}};
  EXPECT_THAT(error(report, "a"), HasSubstr("if an earlier lyrefit wrote it: fit it again"));
  report = Shared();
  report["parameters"].erase("EgRef");
  EXPECT_THAT(error(report, "a"), HasSubstr("no value for Eg"));
}

}  // namespace
}  // namespace lyrefit
