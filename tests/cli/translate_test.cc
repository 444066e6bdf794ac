#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

const std::string kTranslateCell = std::string("translate ") + LYREFIT_DATA_DIR + "/rtc_france ";
const std::string kAt = "--irradiance-Wm2 1000 ";
const std::string kQuickTranslation =
    "--draws 200 --effects nonohmic_shunt --alpha 0.05% --beta -0.35% ";

// Every verb gives the same warning, and translate gives no pass or fail for an impossible power.
TEST(TranslateVerb, JudgesNoMilliampereReadAsAmpere) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  std::string rows = "voltage_V,current_A\n";
  for (int k = 0; k <= 60; ++k) {
    const double v = 0.61 * k;
    rows += fmt::format("{},{}\n", v, 8000 - 2 * v - 1.2e-9 * std::expm1(v / 36.0 * 29.4));
  }
  const std::string file = folder.Write("milliampere.csv", rows);
  const std::string at = " --cells 60 --temperature-C 25 ";
  const std::string brief = "translate " + file + at + kQuickTranslation +
                            "--procedures desoto --irradiance-Wm2 800 --rated-W 300 --brief";
  const AppResult result = RunApp(brief);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("doubtful"));
  EXPECT_THAT(result.out, ::testing::Not(HasSubstr("pass")));
  constexpr char kSays[] = "more than any cell gives";
  for (const std::string& verb :
       {std::string("fit --intervals none "), std::string("diagnose --no-held-out "),
        "translate --rated-W 300 --irradiance-Wm2 800 --procedures desoto " + kQuickTranslation}) {
    const AppResult text = RunApp(verb + file + at);
    std::string flat = text.out;
    std::replace(flat.begin(), flat.end(), '\n', ' ');
    EXPECT_THAT(flat.substr(0, 400), HasSubstr(kSays)) << verb;
    const json document = json::parse(RunApp(verb + file + at + " --json -").out, nullptr, false);
    ASSERT_TRUE(document.is_object()) << verb;
    EXPECT_THAT(document["warnings"].dump(), HasSubstr(kSays)) << verb;
    if (!document.contains("field_test")) continue;
    EXPECT_EQ(document["field_test"]["zone"], "doubtful");
    EXPECT_EQ(document["field_test"]["pass"], false);
  }
}

TEST(TranslateVerb, SaysWhatTheSensorReadAndWhatTheCellsHave) {
  const std::string back = kTranslateCell + kAt + kQuickTranslation +
                           "--procedures desoto --temperature-C 33 --temperature-from back ";
  const AppResult result = RunApp(back);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("33.0 C by a sensor on the back"));
  EXPECT_THAT(result.out, HasSubstr("cells +2.50 K (1.5 K, k = 2): 35.5 C"));
  const json corrected = json::parse(RunApp(back + "--json -").out, nullptr, false);
  ASSERT_TRUE(corrected.is_object());
  EXPECT_DOUBLE_EQ(corrected["read_temperature_C"].get<double>(), 33);
  EXPECT_DOUBLE_EQ(corrected["cell_correction_K"].get<double>(), 2.5);
  EXPECT_DOUBLE_EQ(corrected["inputs"]["temperature_C"].get<double>(), 35.5);
  const json cells = json::parse(RunApp(back + "--cell-correction 0 --json -").out, nullptr, false);
  ASSERT_TRUE(cells.is_object());
  EXPECT_DOUBLE_EQ(cells["inputs"]["temperature_C"].get<double>(), 33);
}

TEST(TranslateVerb, WarnsOfStepsThatNobodyMeasured) {
  const AppResult result =
      RunApp(kTranslateCell + "--irradiance-Wm2 60 " + kQuickTranslation + "--procedures desoto");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("the stated uncertainty is too small"));
}

TEST(TranslateVerb, SaysTheRecommendedResultFirst) {
  const AppResult result = RunApp(kTranslateCell + kAt + kQuickTranslation + "--to STC --verbose");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::size_t answer = result.out.find("here, k = 2"), table = result.out.find("Procedures");
  ASSERT_NE(answer, std::string::npos) << result.out;
  EXPECT_LT(answer, table);
  EXPECT_THAT(result.out, HasSubstr("Recommended is "));
  EXPECT_THAT(result.out, HasSubstr("Budget of Pmax"));
  EXPECT_THAT(result.out, HasSubstr("needs a second curve"));
  EXPECT_THAT(result.out, HasSubstr("200 draws (seed 1)"));
}

TEST(TranslateVerb, WritesWhatItPrints) {
  const AppResult text =
      RunApp(kTranslateCell + kAt + kQuickTranslation + "--rated-W 0.3 --tolerance -3,+3 --json -");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  const json j = json::parse(text.out, nullptr, false);
  ASSERT_FALSE(j.is_discarded());
  EXPECT_EQ(j["results"].size(), 7U);
  EXPECT_EQ(j["target"]["irradiance_W_m2"], 1000);
  EXPECT_EQ(j["seed"], 1);
  EXPECT_TRUE(j["field_test"]["pass"].get<bool>());
  for (const json& result : j["results"]) {
    EXPECT_EQ(result["computed"].get<bool>(), result["why_not"].get<std::string>().empty());
    if (!result["computed"].get<bool>()) continue;
    EXPECT_EQ(result["budget"]["results"].size(), 6U);
    EXPECT_GT(result["key_points"]["max_power_W"].get<double>(), 0.3);
  }
  const AppResult csv = RunApp(kTranslateCell + kAt + kQuickTranslation + "--csv -");
  ASSERT_EQ(csv.exit_code, 0) << csv.err;
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 8);
  const AppResult again = RunApp(kTranslateCell + kAt + kQuickTranslation + "--csv - --threads 1");
  EXPECT_EQ(csv.out, again.out);
}

TEST(TranslateVerb, IsBriefWhereItIsAskedTo) {
  const AppResult result = RunApp(kTranslateCell + kAt + kQuickTranslation +
                                  "--procedures iec4,desoto --to 800,25 --brief");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1);
  EXPECT_THAT(result.out, HasSubstr("W at 800 W/m2, 25 C (k = 2, "));
}

}  // namespace
}  // namespace lyrefit
