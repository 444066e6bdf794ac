#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(CertifyVerb, PrintsTheCertificateByDefault) {
  const AppResult result = RunApp("certify " + kRtc);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("how low the RMSE of rtc_france can go"));
  EXPECT_THAT(result.out, HasSubstr("2 diodes attain the floor"));
}

TEST(CertifyVerb, WritesJsonAloneOnRequest) {
  const AppResult result = RunApp("certify " + kRtc + " --models sd --json -");
  EXPECT_EQ(result.exit_code, 0);
  const json j = json::parse(result.out, nullptr, false);
  ASSERT_FALSE(j.is_discarded());
  EXPECT_NEAR(j["floor"]["rmse_A"].get<double>(), 9.824848761e-4, 1e-12);
  EXPECT_EQ(j["models"].size(), 1U);
  EXPECT_EQ(j["models"][0]["certified"], true);
}

TEST(CertifyVerb, TakesRangesAndDrawsPictures) {
  const TempFolder folder;
  const std::string picture = folder.Path("proof.svg");
  const AppResult result =
      RunApp("certify " + kRtc + " --n-lower 0.5 --n-upper 4 --models td --brief --plot '" +
             picture + "'");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, StartsWith("rtc_france: floor 9.449435199e-04 A measured-current"));
  EXPECT_THAT(FileText(picture), HasSubstr("</svg>"));
}

TEST(CertifyVerb, TakesTheBoxesThatFitTakes) {
  const AppResult result =
      RunApp("certify " + DataFolder("msx60") + " --bounds paper --models dd --json -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out, nullptr, false);
  ASSERT_FALSE(j.is_discarded());
  EXPECT_EQ(j["bounds"], "paper");
  const AppResult renamed =
      RunApp("certify " + DataFolder("msx60") + " --bounds table1 --models dd --json -");
  EXPECT_EQ(json::parse(renamed.out)["models"][0]["rmse_A"], j["models"][0]["rmse_A"]);
  EXPECT_EQ(json::parse(renamed.out)["bounds"], "table1");
  EXPECT_EQ(j["ranges"]["Rsh"], json({150, 3000}));
  EXPECT_EQ(j["ranges"]["diodes"][1]["Is"], json({1e-8, 1e-6}));
  EXPECT_NEAR(j["models"][0]["rmse_A"].get<double>(), 9.013852839e-4, 1e-12);
  EXPECT_GE(j["models"][0]["parameters"]["saturation_current_2"]["value"], 1e-8);
  const AppResult text = RunApp("certify " + kRtc + " --bounds literature --models sd");
  EXPECT_THAT(text.out, HasSubstr("each diode of a model has Is in [0, 1e-06] A"));
  const AppResult single = RunApp("certify " + kRtc + " --models sd --rsh-upper 30");
  EXPECT_THAT(single.out, HasSubstr("Rsh in [0, 30] ohm"));
}

TEST(CertifyVerb, EndsWith2WhereSomethingIsNotCertified) {
  const AppResult result = RunApp("certify " + DataFolder("msx60") + " --models dd --effort 20");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, HasSubstr("NO"));
}

TEST(FitVerb, PrintsTheFloorWhenAsked) {
  const AppResult result = RunApp("fit " + kRtc + " --floor --intervals none");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("Floor: no number of diodes with n in [1, 2] brings the "
                                    "solved-current RMSE below"));
}

TEST(CertifyVerb, WritesTheFloorAndTheModelsAsATable) {
  const AppResult result = RunApp("certify " + kRtc + " --models sd --csv -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  std::istringstream lines(result.out);
  std::string head, floor, sd, rest;
  std::getline(lines, head);
  std::getline(lines, floor);
  std::getline(lines, sd);
  EXPECT_EQ(head,
            "model,certified,rmse_A,lower_bound_A,gap,above_floor,Iph_A,Is1_A,n1,Rs_ohm,Rsh_ohm");
  EXPECT_THAT(floor, StartsWith("floor,yes,0.00098248487"));
  EXPECT_THAT(sd, StartsWith("sd,yes,0.00098602187"));
  for (const std::string& line : {floor, sd}) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 10) << line;
  }
  EXPECT_FALSE(std::getline(lines, rest));
}

}  // namespace
}  // namespace lyrefit
