#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kRowsFile = DataFolder("paper/rows.csv");
const std::string kHead = "source,device,model,algorithm,rmse_A,Iph_A,Rs_ohm,Rsh_ohm,Is1_A,n1\n";
const std::string kGoodRow =
    "T,rtc_france,sd,a,9.8602E-04,0.760776,0.036377,53.7185,3.23021E-07,1.48118\n";

TEST(AuditVerb, AuditsThePaperAndEndsWell) {
  SKIP_IF_SANITIZED();
  const AppResult result = RunApp("audit '" + kRowsFile + "'");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("per cell (x 36)"));
  EXPECT_THAT(result.out, HasSubstr("at 75 C in place of 25 C"));
  EXPECT_THAT(result.out, HasSubstr("Is2 in A instead of uA"));
  EXPECT_THAT(result.out, HasSubstr("40 rows"));
}

TEST(AuditVerb, WritesJsonAloneOnRequest) {
  SKIP_IF_SANITIZED();
  const json j = json::parse(RunApp("audit '" + kRowsFile + "' --json -").out, nullptr, false);
  ASSERT_FALSE(j.is_discarded());
  EXPECT_EQ(j["findings"].size(), 40U);
}

TEST(AuditVerb, ReportsBadRowsByLineAndAuditsTheRest) {
  const TempFolder folder;
  const std::string rows =
      folder.Write("rows.csv", kHead + kGoodRow + "T,nowhere,sd,b,1e-3,0.76,0.036,53,3e-7,1.48\n" +
                                   "T,rtc_france,sd,c,1e-3,much,0.036,53,3e-7,1.48\n" + kGoodRow);
  const AppResult result = RunApp("audit '" + rows + "' --curves '" + DataFolder("") + "'");
  EXPECT_EQ(result.exit_code, 1);
  const std::string all = result.out + result.err;
  EXPECT_THAT(all, HasSubstr("rows.csv:3"));
  EXPECT_THAT(all, HasSubstr("nowhere"));
  EXPECT_THAT(all, HasSubstr("rows.csv:4"));
  EXPECT_THAT(all, HasSubstr("much"));
  EXPECT_THAT(result.out, HasSubstr("2 rows: reproduces 2; 2 more could not be audited"));
}

TEST(AuditVerb, PrintsNothingThatIsNoUtf8) {
  const TempFolder folder;
  // "Müller" in Windows-1252; the second row has an invalid number.
  const std::string rows = folder.Write(
      "rows.csv", kHead +
                      "M\xfcller,rtc_france,sd,\xb5LO,9.8602E-04,0.760776,0.036377,53.7185,"
                      "3.23021E-07,1.48118\nT,rtc_france,sd,c,m\xfc"
                      "ch,0.76,0.036,53,3e-7,1.48\n");
  const std::string audit = "audit '" + rows + "' --curves '" + DataFolder("") + "'";
  const AppResult text = RunApp(audit);
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_THAT(text.err,
              HasSubstr("rows.csv: the file is not UTF-8 (line 2): read as Windows-1252"));
  EXPECT_THAT(text.out, HasSubstr("\xc2\xb5LO"));
  EXPECT_THAT(text.out + text.err, HasSubstr("found 'm\xc3\xbc"
                                             "ch'"));
  EXPECT_THAT(RunApp(audit + " --quiet --json -").out, HasSubstr("\"source\": \"M\xc3\xbcller\""));
  EXPECT_THAT(RunApp(audit + " --quiet --csv -").out, HasSubstr("M\xc3\xbcller,"));
  // A name with invalid UTF-8 bytes is printed with replacement characters.
  const AppResult refused = RunApp("audit '" + folder.Path("no\xff") + "'");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("no\xef\xbf\xbd"));
}

}  // namespace
}  // namespace lyrefit
