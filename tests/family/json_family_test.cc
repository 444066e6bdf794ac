#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "sample_family.h"

#include "lyrefit/family/family_documents.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using Set = std::set<std::string>;

const Set kPair = {"measured_current_A", "solved_current_A"};
const Set kInterval = {"value", "standard_error", "low_95", "high_95"};

TEST(FamilyJson, HoldsExactlyTheKeysOfTheContract) {
  const json j = json::parse(FamilyJson(MakeSampleFamily(8).report));
  EXPECT_EQ(Keys(j), (Set{"lyrefit_version",
                          "set",
                          "family",
                          "model",
                          "shunt",
                          "recombination",
                          "cells_in_series",
                          "objective",
                          "constants",
                          "parameters",
                          "sensor_offsets",
                          "temperature_coefficients",
                          "reference",
                          "rmse",
                          "noise_A",
                          "held_out",
                          "without_outliers",
                          "candidates",
                          "correlations",
                          "search",
                          "refine",
                          "seconds",
                          "individual_fits",
                          "options",
                          "rejected",
                          "assumptions",
                          "warnings",
                          "interrupted",
                          "usable",
                          "curves",
                          "against",
                          "in_sample",
                          "errors",
                          "weights",
                          "weights_gain",
                          "residuals",
                          "key_points",
                          "equal_devices"}));
  EXPECT_EQ(Keys(j["set"]), (Set{"name", "source"}));
  EXPECT_EQ(Keys(j["parameters"]),
            (Set{"I_L_ref", "I_o_ref", "n", "R_s", "R_sh_ref", "alpha_sc", "EgRef", "dEgdT"}));
  EXPECT_EQ(Keys(j["parameters"]["R_s"]),
            (Set{"symbol", "name", "unit", "searched", "refined", "standard_error", "low_95",
                 "high_95", "interval", "at_bound", "bound_side", "identifiable", "reason", "fixed",
                 "lower", "upper", "whole", "jackknife", "under_errors"}));
  EXPECT_EQ(Keys(j["sensor_offsets"]), (Set{"irradiance_Wm2", "temperature_K"}));
  EXPECT_EQ(Keys(j["rmse"]), (Set{"random_baseline", "searched", "searched_all", "refined"}));
  EXPECT_EQ(Keys(j["rmse"]["refined"]), (Set{"measured_current_A", "solved_current_A", "curves"}));
  EXPECT_EQ(Keys(j["held_out"]),
            (Set{"how", "curves", "rmse", "median_solved_current_A", "largest_solved_current_A",
                 "largest_id", "median_individual_solved_current_A"}));
  ASSERT_EQ(j["against"].size(), 1U);
  EXPECT_EQ(Keys(j["against"][0]), (Set{"name", "law", "curves", "rmse", "median_solved_current_A",
                                        "largest_solved_current_A", "largest_id"}));
  EXPECT_TRUE(j["in_sample"].is_null());
  EXPECT_EQ(Keys(j["without_outliers"]), (Set{"ids", "rmse", "parameters"}));
  EXPECT_EQ(
      Keys(j["candidates"][0]),
      (Set{"law", "model", "rmse", "held_out_solved_current_A", "held_out_median_solved_current_A",
           "behind_best_standard_errors", "free_parameters", "chosen"}));
  EXPECT_EQ(Keys(j["temperature_coefficients"]["alpha_sc"]), (Set{"unit", "interval"}));
  EXPECT_EQ(Keys(j["rejected"][0]), (Set{"id", "error"}));
  EXPECT_EQ(Keys(j["refine"]), (Set{"termination", "projected_gradient"}));
}

TEST(FamilyJson, HoldsEveryCurve) {
  const json j = json::parse(FamilyJson(MakeSampleFamily(60).report));
  ASSERT_EQ(j["curves"].size(), 60U);
  const json& curve = j["curves"][2];
  EXPECT_EQ(Keys(curve), (Set{"id",
                              "role",
                              "reason",
                              "outlier",
                              "points",
                              "irradiance_Wm2",
                              "irradiance_known",
                              "irradiance_offset_Wm2",
                              "temperature_C",
                              "temperature_known",
                              "temperature_offset_K",
                              "short_circuit_current_A",
                              "parameters",
                              "rmse",
                              "individual_parameters",
                              "individual_rmse",
                              "isc_excess",
                              "voc_excess_V",
                              "key_points",
                              "mean_residual_A",
                              "residual_A"}));
  EXPECT_EQ(curve["outlier"], true);
  EXPECT_EQ(curve["residual_A"].size(), 25U);
  EXPECT_EQ(Keys(curve["rmse"]), kPair);
  EXPECT_EQ(Keys(curve["irradiance_offset_Wm2"]), kInterval);
  EXPECT_TRUE(curve["temperature_offset_K"].is_null());
  EXPECT_EQ(Keys(curve["individual_parameters"]), (Set{"photocurrent", "saturation_current", "n",
                                                       "resistance_series", "resistance_shunt"}));
  EXPECT_EQ(j["curves"][0]["role"], "held-out");
  EXPECT_EQ(j["curves"][1]["reason"], "taken in the dark");
}

TEST(FamilyJson, EchoesTheSearchAndTheOptions) {
  const json j = json::parse(FamilyJson(MakeSampleFamily(8).report));
  EXPECT_EQ(j["search"]["seed"], 0);
  EXPECT_EQ(j["search"]["curves"], (json{"sweep-3", "sweep-5"}));
  EXPECT_EQ(j["options"][0]["name"], "folds");
  EXPECT_EQ(j["rmse"]["searched"]["curves"], "search");
  EXPECT_DOUBLE_EQ(j["rmse"]["refined"]["measured_current_A"].get<double>(), 1.534e-3);
  EXPECT_EQ(Keys(j["parameters"]["n"]["jackknife"]), kInterval);
  EXPECT_TRUE(j["parameters"]["dEgdT"]["jackknife"].is_null());
}

TEST(FamilyJson, HoldsCurvesFittedOneByOne) {
  const json j = json::parse(FamilyJson(MakeFreeSample(8).report));
  EXPECT_EQ(j["family"], "free");
  EXPECT_TRUE(j["parameters"].empty());
  EXPECT_TRUE(j["reference"].is_null());
  EXPECT_TRUE(j["held_out"].is_null());
  EXPECT_TRUE(j["curves"][0]["parameters"].is_null());
  EXPECT_TRUE(j["curves"][0]["rmse"]["solved_current_A"].is_null());
  EXPECT_NEAR(j["curves"][0]["individual_parameters"]["resistance_series"].get<double>(), 0.3162,
              1e-12);
}

TEST(FamilyJson, TakesNamesThatAreNotUtf8) {
  FamilyReport report = MakeSampleFamily(8).report;
  report.curves[3].id = "caf\xe9";
  EXPECT_TRUE(json::accept(FamilyJson(report)));
}

}  // namespace
}  // namespace lyrefit
