#include "lyrefit/report/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "json_keys.h"
#include "sample_diagnosis.h"
#include "sample_reference.h"

#include "lyrefit/diagnose/diagnosis_documents.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using Set = std::set<std::string>;

// The parameter with this symbol.
json Of(const json& parameters, const std::string& symbol) {
  for (const json& parameter : parameters) {
    if (parameter["symbol"] == symbol) return parameter;
  }
  return {};
}

TEST(DiagnosisJson, HoldsExactlyTheKeysOfTheContract) {
  const json j = json::parse(DiagnosisJson(SampleDiagnosis()));
  EXPECT_EQ(Keys(j), (Set{"lyrefit_version",
                          "name",
                          "source",
                          "setup",
                          "base",
                          "base_sentence",
                          "objective",
                          "seed",
                          "floor_current",
                          "floor_power",
                          "probability",
                          "verdict",
                          "gain",
                          "evidence",
                          "trials",
                          "non_default_options",
                          "assumptions",
                          "warnings",
                          "interrupted",
                          "usable",
                          "seconds",
                          "curves",
                          "points",
                          "device_findings"}));
  EXPECT_EQ(Keys(j["verdict"]),
            (Set{"found", "unexplained", "sentence", "causes", "below_floor", "lack_of_fit",
                 "remaining", "comparison", "not_shown", "probability_none", "resistance_loss",
                 "fill_factor", "recoverable_power_W", "cannot_be_excluded"}));
  EXPECT_EQ(
      Keys(j["verdict"]["causes"][0]),
      (Set{"id",          "effect",      "title",          "sentence",     "equivalents",
           "separate_by", "parameters",  "mechanisms",     "evidence",     "acts",
           "points",      "in_words",    "current_effect", "power_effect", "recoverable_power_W",
           "at_least",    "probability", "alternatives",   "group",        "action",
           "fact_sheet"}));
  EXPECT_EQ(Keys(j["verdict"]["cannot_be_excluded"][0]),
            (Set{"id", "biases", "sentence", "separate_by"}));
  EXPECT_EQ(Keys(j["trials"][0]), (Set{"effect", "title", "tried", "why_not", "rmse_A", "misfit",
                                       "log_evidence", "probability_material", "probability",
                                       "delta_aicc", "held_out_rmse_A", "kept", "parameters"}));
  EXPECT_EQ(Keys(j["gain"]), (Set{"rmse_before_A", "rmse_after_A", "held_out_before_A",
                                  "held_out_after_A", "held_out_gain_A2", "held_out_gain_error_A2",
                                  "folds", "by_sweeps", "gain", "sentence", "parameter_shift"}));
  EXPECT_EQ(Keys(j["evidence"]),
            (Set{"kind", "noise", "misfit_ratio", "autocorrelation", "grid_step_A", "grid_step_V",
                 "clipped_points", "clip_level_A", "largest_error", "residuals",
                 "whiteness_p_value", "whiteness_after_p_value", "findings"}));
  EXPECT_EQ(Keys(j["points"]), (Set{"curve", "segment", "voltage_V", "current_A", "sigma_A",
                                    "before_A", "after_A", "without_causes_A", "time_s"}));
}

TEST(DiagnosisJson, TellsTheCauseWithItsInterval) {
  const json j = json::parse(DiagnosisJson(SampleDiagnosis()));
  EXPECT_EQ(j["objective"], "solved-current");
  EXPECT_EQ(j["verdict"]["found"], true);
  const json& cause = j["verdict"]["causes"][0];
  EXPECT_EQ(cause["id"], "irr_step");
  EXPECT_EQ(cause["equivalents"], json({"drift"}));
  ASSERT_EQ(cause["parameters"].size(), 2U);
  const json &depth = cause["parameters"][0], &from = cause["parameters"][1];
  EXPECT_EQ(Keys(depth),
            (Set{"effect", "symbol", "name", "unit", "value", "low_95", "high_95", "at_bound"}));
  EXPECT_EQ(depth["effect"], "irr_step");
  EXPECT_EQ(depth["symbol"], "d");
  EXPECT_EQ(depth["value"], -0.019);
  EXPECT_EQ(depth["low_95"], -0.0212);
  EXPECT_EQ(depth["high_95"], -0.0168);
  EXPECT_EQ(from["symbol"], "V1");
  EXPECT_EQ(from["value"], 12.1);
  EXPECT_EQ(from["unit"], "V");
  EXPECT_EQ(from["at_bound"], true);
  const json& shift = Of(j["gain"]["parameter_shift"], "Rs");
  EXPECT_EQ(Keys(shift), (Set{"symbol", "name", "unit", "before", "after", "standard_error"}));
  EXPECT_EQ(shift["before"], 0.262);
  EXPECT_EQ(j["points"]["voltage_V"].size(), 60U);
  EXPECT_EQ(Of(j["trials"][0]["parameters"], "k")["unit"], "A/V");
}

TEST(DiagnosisJson, TellsPowerAndAlternativesAndWhatTheDeviceLacks) {
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.verdict.causes = {SampleShadingCause()};
  diagnosis.device_findings = {SampleLeak()};
  const json j = json::parse(DiagnosisJson(diagnosis));
  const json& cause = j["verdict"]["causes"][0];
  EXPECT_EQ(cause["recoverable_power_W"], json::parse(R"({"value": 16.7, "low_95": 15.1,
                                                          "high_95": 18.3})"));
  EXPECT_EQ(cause["at_least"], false);
  EXPECT_EQ(cause["probability"], 0.86);
  EXPECT_EQ(cause["alternatives"][0], json::parse(R"({"id": "weak_cell", "title": "weak cells",
                                                      "probability": 0.12})"));
  EXPECT_EQ(cause["group"], "device");
  EXPECT_EQ(cause["fact_sheet"], "PVFS 3-3");
  const json& finding = j["device_findings"][0];
  EXPECT_EQ(Keys(finding),
            (Set{"id", "symbol", "value", "low_95", "high_95", "healthy_limit", "power_loss",
                 "sentence", "title", "about", "action", "separate_by", "recoverable_power_W"}));
  EXPECT_EQ(finding["value"], 0.031);
}

TEST(DiagnosisJson, WritesNullForWhatIsNotKnown) {
  const json j = json::parse(DiagnosisJson(SampleDiagnosis()));
  EXPECT_TRUE(j["points"]["time_s"][0].is_null());
  EXPECT_TRUE(Of(j["gain"]["parameter_shift"], "Pmax")["standard_error"].is_null());
  const json& untried = j["trials"][3];
  EXPECT_EQ(untried["tried"], false);
  EXPECT_EQ(untried["why_not"], "needs sweeps in both directions");
  EXPECT_TRUE(untried["rmse_A"].is_null());
  EXPECT_EQ(untried["parameters"], json::array());
  EXPECT_TRUE(j["trials"][0]["why_not"].is_null());
}

TEST(DiagnosisJson, TakesNamesThatAreNotUtf8) {
  Diagnosis diagnosis = SampleDiagnosis();
  diagnosis.name = "caf\xe9";
  EXPECT_TRUE(json::accept(DiagnosisJson(diagnosis)));
}

TEST(DiagnosisJson, WritesSeveralAsAnArray) {
  const json j = json::parse(DiagnosisJson({SampleDiagnosis(), SampleUpDown()}));
  ASSERT_EQ(j.size(), 2U);
  EXPECT_EQ(j[1]["name"], "up_down");
}

TEST(AnswersJson, ListsEachCauseWithItsEquivalents) {
  const json j = json::parse(
      AnswersJson({"a", "b", "c"}, {SampleDiagnosis(), SampleLitAndDark(), SampleUpDown()}));
  EXPECT_EQ(j["a"], json::parse(R"([["irr_step", "drift"]])"));
  EXPECT_EQ(j["b"], json::array());
  EXPECT_EQ(j["c"].size(), 2U);
}

TEST(ReferenceJson, HoldsTheComparisonAndTheDiagnosis) {
  const json j = json::parse(ReferenceJson(SampleReference(), SampleDiagnosis()));
  EXPECT_EQ(j["diagnosis"]["name"], "sample_module");
  const json& c = j["comparison"];
  EXPECT_EQ(c["name"], "today");
  EXPECT_EQ(c["differs"], true);
  EXPECT_EQ(c["p_value"], 3e-6);
  EXPECT_EQ(c["common"], 0.0011);
  EXPECT_EQ(c["references"].size(), 12U);
  EXPECT_EQ(c["rows"][0]["symbol"], "FF");
  EXPECT_EQ(c["rows"][0]["expected"], 73.7);
  EXPECT_EQ(c["rows"][0]["power"], -0.0068);
  EXPECT_TRUE(c["rows"][1]["power"].is_null());
  EXPECT_EQ(c["causes"][0]["id"], "series_resistance");
  EXPECT_EQ(c["causes"][0]["size"], 8);
}

TEST(OutlierSweepsJson, ListsAllSweeps) {
  const json j = json::parse(OutlierSweepsJson(SampleOutlierSweeps()));
  EXPECT_EQ(j["outliers"], 1);
  ASSERT_EQ(j["sweeps"].size(), 2U);
  EXPECT_EQ(j["sweeps"][1]["differs"], false);
  EXPECT_EQ(j["rejected"][0], "night: the curve is dark");
}

}  // namespace
}  // namespace lyrefit
