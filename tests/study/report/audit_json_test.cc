#include "lyrefit/study/report/documents.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sample_audit.h"

namespace lyrefit {
namespace {

using nlohmann::json;

TEST(AuditJson, HoldsEveryFinding) {
  const json j = json::parse(AuditJson(SampleAudit()));
  EXPECT_EQ(j["lyrefit_version"], "1.2.3");
  EXPECT_EQ(j["rows_file"], "rows.csv");
  EXPECT_EQ(j["objective"], "measured-current");
  EXPECT_TRUE(j["constants"].is_null());
  ASSERT_EQ(j["findings"].size(), 3U);
  const json& good = j["findings"][0];
  EXPECT_EQ(good["row"]["source"], "Table 1");
  EXPECT_EQ(good["row"]["line"], 7);
  EXPECT_EQ(good["row"]["model"], "sd");
  EXPECT_EQ(good["row"]["claimed"]["text"], "9.8602E-04");
  EXPECT_EQ(good["row"]["claimed"]["rmse_A"], 9.8602e-4);
  EXPECT_EQ(good["verdict"], "reproduces");
  EXPECT_EQ(good["stated"]["rmse"]["measured_current_A"], 9.860219e-4);
  EXPECT_EQ(good["stated"]["parameters"]["resistance_series"], 0.0363);
  EXPECT_EQ(good["stated"]["cell_temperature_C"], 33);
  EXPECT_EQ(good["stated"]["constants"], json::array({"literature"}));
  EXPECT_TRUE(good["bounds"].is_null());
  EXPECT_TRUE(good["nearest"].is_null());
  EXPECT_TRUE(good["temperatures"].is_null());
  EXPECT_TRUE(good["optimum_rmse_A"].is_null());
}

TEST(AuditJson, HoldsExplanationsAndEvidence) {
  const json j = json::parse(AuditJson(SampleAudit()));
  const json& explanation = j["findings"][1]["explanations"][0];
  EXPECT_EQ(explanation["changes"][0], "with Is1 in A instead of uA");
  EXPECT_EQ(explanation["low_temperature_C"], 74.999);
  EXPECT_EQ(explanation["readings_tried"], 474);
  EXPECT_EQ(explanation["accidental_matches"], 0.003);
  EXPECT_EQ(explanation["left_bounds"][0]["name"], "resistance_series");
  EXPECT_EQ(explanation["left_bounds"][0]["lower"], 0.2);
  const json& fails = j["findings"][2];
  EXPECT_EQ(fails["bounds"], "paper");
  EXPECT_EQ(fails["temperatures"]["at_claim_C"], json::array({31.5, 34.25}));
  EXPECT_EQ(fails["optimum_rmse_A"], 9.8602187e-4);
  EXPECT_EQ(fails["nearest"]["cell_temperature_C"], 75);
}

TEST(AuditJson, SaysHowLowAClaimCanGo) {
  AuditReport report = SampleAudit();
  report.findings[0].lowest = AuditLowest{};
  report.findings[0].lowest->rmse_A = 7.73e-4;
  report.findings[0].lowest->newton_step_A = 7.72e-4;
  report.findings[0].stated.parameters.clear();
  const json j = json::parse(AuditJson(report));
  const json& lowest = j["findings"][0]["lowest"];
  EXPECT_EQ(lowest["rmse_A"], 7.73e-4);
  EXPECT_EQ(lowest["newton_step_rmse_A"], 7.72e-4);
  EXPECT_TRUE(lowest["lower_bound_A"].is_null());
  EXPECT_TRUE(lowest["reached_A"].is_null());
  EXPECT_TRUE(j["findings"][0]["stated"]["parameters"].empty());
  EXPECT_TRUE(j["findings"][1]["lowest"].is_null());
  EXPECT_EQ(j["findings"][1]["stated"]["newton_step"], false);
}

TEST(AuditJson, ListsBadRowsAndCountsVerdicts) {
  const json j = json::parse(AuditJson(SampleAudit()));
  ASSERT_EQ(j["bad_rows"].size(), 1U);
  EXPECT_EQ(j["bad_rows"][0]["line"], 9);
  EXPECT_EQ(j["bad_rows"][0]["column"], 4);
  EXPECT_EQ(j["summary"]["reproduces"], 1);
  EXPECT_EQ(j["summary"]["does_not_reproduce"], 1);
  EXPECT_EQ(j["summary"]["another_device"], 0);
}

TEST(AuditJson, SurvivesTextThatIsNotUtf8) {
  AuditReport report = SampleAudit();
  report.findings[0].row.algorithm = "\xff";
  EXPECT_TRUE(json::accept(AuditJson(report)));
}

}  // namespace
}  // namespace lyrefit
