#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "sample_fits.h"

namespace lyrefit {
namespace {

using nlohmann::json;

json Parsed(const FitReport& report) { return json::parse(JsonReport(report)); }

TEST(JsonReport, HoldsExactlyTheKeysOfTheContract) {
  const json j = Parsed(SampleReport());
  const std::set<std::string> top = {
      "lyrefit_version", "curve",       "model",     "objective",
      "constants",       "bounds",      "floor",     "parameters",
      "nNsVth",          "singlediode", "rmse",      "largest_error",
      "key_points",      "information", "residuals", "correlations",
      "search",          "refine",      "intervals", "model_choice",
      "options",         "interrupted", "usable",    "not_usable_because",
      "warnings",        "data",        "errors",    "variants"};
  EXPECT_EQ(Keys(j), top);
  const std::set<std::string> search = {
      "algorithm",         "seed",        "run",     "population", "iterations", "evaluations",
      "curve_evaluations", "termination", "message", "seconds",    "elites",     "trace"};
  EXPECT_EQ(Keys(j["search"]), search);
  const std::set<std::string> refine = {
      "termination",        "message",   "starts",  "agreeing",   "winner",
      "projected_gradient", "condition", "seconds", "start_list", "local_optima"};
  EXPECT_EQ(Keys(j["refine"]), refine);
}

TEST(JsonReport, TellsTheFloorWhereItWasAskedFor) {
  FitReport report = SampleReport();
  EXPECT_TRUE(Parsed(report)["floor"].is_null());
  report.floor = {Objective::kSolvedCurrent, 9.8e-4, 9.7e-4, 1e-2, 1, 2, 0.01, false};
  const json floor = Parsed(report)["floor"];
  EXPECT_EQ(Keys(floor),
            (std::set<std::string>{"objective", "rmse_A", "lower_bound_A", "gap", "n_lower",
                                   "n_upper", "refined_above", "minimised"}));
  EXPECT_EQ(floor["objective"], "solved-current");
  EXPECT_EQ(floor["rmse_A"], 9.8e-4);
  EXPECT_EQ(floor["gap"], 1e-2);
  EXPECT_EQ(floor["minimised"], false);
  EXPECT_EQ(floor["lower_bound_A"], 9.7e-4);
  EXPECT_EQ(floor["refined_above"], 0.01);
}

TEST(JsonReport, CountsOptimaAndListsVariantsOfAModelWithEffects) {
  FitReport report = SampleReport();
  EXPECT_TRUE(Parsed(report)["refine"]["local_optima"].is_null());
  EXPECT_TRUE(Parsed(report)["variants"].is_null());
  EXPECT_TRUE(Parsed(report)["parameters"]["n"]["whole"].is_null());
  report.refine.starts.resize(49);
  report.refine.local_optima = OptimumCount{14, 5, 6, {12, 4, 5, 3, 1}, 1.5};
  report.variants = {{"d, Vb free; a = 0", 2, 1.2e-3, 87.5, false, false},
                     {"d, Vb, m, A free", 4, 7.73e-4, 0, true, true}};
  report.estimates[2].bounds.whole = 0.25;
  const json j = Parsed(report);
  EXPECT_EQ(j["refine"]["start_list"].size(), 49u);
  EXPECT_EQ(
      j["refine"]["local_optima"],
      (json{{"ends", 14},
            {"local_optima", 5},
            {"best_visits", 6},
            {"independent",
             {{"ends", 12}, {"local_optima", 4}, {"best_visits", 5}, {"once", 3}, {"twice", 1}}},
            {"unseen", 1.5}}));
  ASSERT_EQ(j["variants"].size(), 2u);
  EXPECT_EQ(j["variants"][0], (json{{"what", "d, Vb free; a = 0"},
                                    {"free", 2},
                                    {"solved_current_rmse_A", 1.2e-3},
                                    {"bic_above", 87.5},
                                    {"finished", false},
                                    {"chosen", false}}));
  EXPECT_EQ(j["variants"][1]["chosen"], true);
  EXPECT_EQ(j["parameters"]["n"]["whole"], 0.25);
  EXPECT_EQ(j["parameters"]["n"]["fixed"], false);
}

TEST(JsonReport, NamesParametersAsPvlibDoes) {
  FitReport report = SampleReport();
  EXPECT_EQ(Keys(Parsed(report)["parameters"]),
            (std::set<std::string>{"photocurrent", "saturation_current", "n", "resistance_series",
                                   "resistance_shunt"}));
  report.model = Model::kTripleDiode;
  report.estimates.clear();
  for (const ParameterInfo& info : MakeDevice(report.model, report.curve.conditions).parameters) {
    Estimate e;
    e.info = info;
    report.estimates.push_back(e);
  }
  EXPECT_EQ(Keys(Parsed(report)["parameters"]),
            (std::set<std::string>{"photocurrent", "saturation_current", "saturation_current_2",
                                   "saturation_current_3", "n", "n_2", "n_3", "resistance_series",
                                   "resistance_shunt"}));
  EXPECT_TRUE(Parsed(report)["singlediode"].is_null());
}

// Every parameter, also one of an effect, has an object with equal keys.
TEST(JsonReport, SaysOfAParameterWhatItIs) {
  FitReport report = SampleReport();
  Estimate depth;
  depth.info = {"shading.d", "shading_shading_depth", "", "light that is missing"};
  depth.refined = 0.25;
  report.estimates.push_back(depth);
  const json parameters = Parsed(report)["parameters"];
  const json& rs = parameters["resistance_series"];
  EXPECT_EQ(rs["symbol"], "Rs");
  EXPECT_EQ(rs["name"], "resistance_series");
  EXPECT_EQ(rs["unit"], "ohm");
  EXPECT_FALSE(rs.contains("effect"));
  const json& d = parameters["shading.d"];
  EXPECT_EQ(d["effect"], "shading");
  EXPECT_EQ(d["symbol"], "d");
  EXPECT_EQ(d["name"], "shading_depth");
  EXPECT_EQ(d["refined"], 0.25);
  EXPECT_TRUE(d["searched"].is_null());
}

TEST(JsonReport, BringsBackTheSameBits) {
  const FitReport report = SampleReport();
  const json j = Parsed(report);
  EXPECT_EQ(j["parameters"]["saturation_current"]["refined"].get<double>(), report.refined[1]);
  EXPECT_EQ(j["rmse"]["refined"]["solved_current_A"].get<double>(),
            report.rmse.refined.solved_current_A);
  EXPECT_EQ(j["singlediode"]["nNsVth"].get<double>(), report.nNsVth);
  EXPECT_EQ(j["data"]["current_A"].get<std::vector<double>>(), report.curve.current_A);
}

TEST(JsonReport, GivesTheFiveArgumentsOfSinglediode) {
  EXPECT_EQ(Keys(Parsed(SampleReport())["singlediode"]),
            (std::set<std::string>{"photocurrent", "saturation_current", "resistance_series",
                                   "resistance_shunt", "nNsVth"}));
}

TEST(JsonReport, HasTheTypesScriptsRelyOn) {
  FitReport report = SampleReport();
  report.estimates[2].at_bound = BoundSide::kUpper;
  const json j = Parsed(report);
  const json& n = j["parameters"]["n"];
  EXPECT_EQ(n["at_bound"], true);
  EXPECT_EQ(n["bound_side"], "upper");
  EXPECT_EQ(n["interval"], "symmetric");
  EXPECT_EQ(n["unit"], "");
  EXPECT_EQ(j["parameters"]["photocurrent"]["at_bound"], false);
  EXPECT_TRUE(j["parameters"]["photocurrent"]["bound_side"].is_null());
  EXPECT_TRUE(j["parameters"]["photocurrent"]["identifiable"].is_boolean());
  EXPECT_EQ(j["refine"]["starts"], 3);
  EXPECT_EQ(j["refine"]["start_list"].size(), 3U);
  EXPECT_EQ(j["search"]["seed"], 7);
  EXPECT_TRUE(j["warnings"].is_array());
  EXPECT_TRUE(j["model_choice"].is_null());
  EXPECT_NEAR(j["curve"]["conditions"]["cell_temperature_C"].get<double>(), 33, 0);
}

TEST(JsonReport, WritesNullForWhatIsNotFinite) {
  FitReport report = SampleReport();
  report.estimates[4].high_95 = kInfinity;
  report.simulated.open_circuit_voltage_V = kUnknown;
  const json j = Parsed(report);
  EXPECT_TRUE(j["parameters"]["resistance_shunt"]["high_95"].is_null());
  EXPECT_TRUE(j["key_points"]["simulated"]["open_circuit_voltage_V"].is_null());
}

TEST(JsonReport, WritesNullForRefinedWithoutAPolish) {
  FitReport report = SampleReport();
  report.polished = false;
  const json j = Parsed(report);
  EXPECT_TRUE(j["parameters"]["n"]["refined"].is_null());
  EXPECT_TRUE(j["rmse"]["refined"]["solved_current_A"].is_null());
  EXPECT_TRUE(j["rmse"]["refined_best_candidate"]["measured_current_A"].is_null());
  EXPECT_TRUE(j["rmse"]["searched"]["solved_current_A"].is_number());
  EXPECT_TRUE(j["singlediode"]["photocurrent"].is_number());
}

TEST(JsonReport, KeepsWallClockTimesUnderSecondsOnly) {
  FitReport report = SampleReport();
  json first = Parsed(report);
  report.search.seconds = 77;
  report.refine.seconds = 77;
  report.interval_seconds = 77;
  json second = Parsed(report);
  EXPECT_NE(first, second);
  RemoveSeconds(&first);
  RemoveSeconds(&second);
  EXPECT_EQ(first, second);
}

TEST(JsonReport, SaysWhyThereAreNoIntervals) {
  FitReport report = SampleReport();
  EXPECT_EQ(Parsed(report)["intervals"]["none_because"], "");
  report.no_intervals_because = "the fit is not usable";
  EXPECT_EQ(Parsed(report)["intervals"]["none_because"], "the fit is not usable");
}

TEST(JsonReport, WritesTheChoiceOfTheModel) {
  FitReport report = SampleReport();
  report.choice = ModelChoice{
      Model::kDoubleDiode, {{Model::kSingleDiode, 1e-3, 2e-3, -10, kUnknown, true}}, "Two diodes."};
  const json choice = Parsed(report)["model_choice"];
  EXPECT_EQ(choice["chosen"], "dd");
  EXPECT_EQ(choice["sentence"], "Two diodes.");
  EXPECT_EQ(choice["candidates"][0]["model"], "sd");
  EXPECT_TRUE(choice["candidates"][0]["f_p_value"].is_null());
}

TEST(JsonReport, SurvivesNamesThatAreNotUtf8) {
  FitReport report = SampleReport();
  report.curve.name = "caf\xe9";
  EXPECT_EQ(Parsed(report)["curve"]["name"], "caf\xef\xbf\xbd");
}

TEST(FitsJson, HoldsEveryReportUnderItsFile) {
  const json list = json::parse(FitsJson(SampleFits()));
  ASSERT_EQ(list.size(), 3U);
  EXPECT_EQ(list[0]["file"], "a.csv");
  json report = list[0];
  report.erase("file");
  EXPECT_EQ(report, json::parse(JsonReport(*SampleFits()[0].report)));
  EXPECT_EQ(list[1]["file"], "b, c.csv");
  EXPECT_EQ(list[1]["error"], "b, c.csv:2:3: expected a number, found 'x'");
  EXPECT_EQ(list[1].size(), 2U);
}

}  // namespace
}  // namespace lyrefit
