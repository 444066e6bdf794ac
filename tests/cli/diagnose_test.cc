#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "repeats.h"
#include "run_app.h"
#include "same_curve.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kVerb = "diagnose '" + DataFolder("rtc_france") + "' ";
// Options of a short run, for tests in which the result does not matter.
const std::string kQuick = "--effects nonohmic_shunt --no-held-out ";

// A string of 20 modules of 60 cells with four of its 60 substrings in shade, and its module's sheet.
class DiagnosedString : public testing::Test {
 protected:
  DiagnosedString() {
    const AppResult made = RunApp(
        "simulate --set Iph=8.1 --set Is1=5e-8 --set n1=1.1 --set Rs=5.4 --set Rsh=11000 --cells "
        "1200 --temperature-C 52 --irradiance-Wm2 880 --with shading:d=0.55,w=0.066667 --noise-A "
        "0.013 --points 100 --out '" +
        curve_ + "'");
    EXPECT_EQ(made.exit_code, 0) << made.err;
  }
  std::string Found(const std::string& more) {
    const AppResult result = RunApp("diagnose '" + curve_ + "' --no-held-out " + more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("partial shading (100 %)"));
    EXPECT_THAT(result.out, HasSubstr("4 of 60 substrings under 45 %"));
    return result.out;
  }
  const TempFolder folder_;
  const std::string curve_ = folder_.Path("string.csv");
};

TEST_F(DiagnosedString, HasTheUsualDiodesWhereNobodyStatesThem) {
  EXPECT_THAT(Found(""), HasSubstr("--bypass-diodes"));
}

TEST_F(DiagnosedString, HasTheDiodesOfTheFlagOrOfTheSheet) {
  EXPECT_THAT(Found("--bypass-diodes 60"), Not(HasSubstr("--bypass-diodes")));
  const std::string sheet = folder_.Write("m.json", R"({"cells_in_series": 60,
      "bypass_diodes": 3, "modules_in_series": 20})");
  for (const char* flag : {"", "--module "}) {
    EXPECT_THAT(Found(flag + ("'" + sheet + "'")),
                HasSubstr("60 bypass diodes: 20 modules of 3 bypass diodes, m.json"));
  }
}

TEST(DiagnoseVerb, ExplainsAnEffect) {
  const AppResult result = RunApp("diagnose --explain nonohmic_shunt");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("non-ohmic shunt (nonohmic_shunt)\n"));
  for (const char* part :
       {"equation", "reference", "data needed", "confused with", "to tell", "bounds"}) {
    EXPECT_THAT(result.out, HasSubstr(part));
  }
}

TEST(DiagnoseVerb, ListsTheCatalogue) {
  const AppResult result = RunApp("diagnose --list");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("nonohmic_shunt"));
  EXPECT_THAT(result.out, HasSubstr("device"));
}

TEST(DiagnoseVerb, PrintsTheDiagnosis) {
  const AppResult result = RunApp(kVerb + kQuick);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("diagnosis of rtc_france"));
  EXPECT_THAT(result.out, HasSubstr("Verdict\n"));
}

TEST(DiagnoseVerb, SaysAllOnlyWhereItIsAsked) {
  const std::string brief = RunApp(kVerb + kQuick).out;
  const std::string whole = RunApp(kVerb + kQuick + "--verbose").out;
  for (const char* part : {"What the readings show", "Effects tried", "How it was found"}) {
    EXPECT_THAT(brief, ::testing::Not(HasSubstr(part)));
    EXPECT_THAT(whole, HasSubstr(part));
  }
}

TEST(DiagnoseVerb, ListsWhatToDoAboutEachEffect) {
  const std::string list = RunApp("diagnose --list").out;
  EXPECT_THAT(list, HasSubstr("PVFS 1-15"));
  EXPECT_THAT(list, HasSubstr("wiring"));
  EXPECT_THAT(list, HasSubstr("open the junction box and test the bypass diodes"));
  EXPECT_THAT(RunApp("diagnose --explain bypass_open").out, HasSubstr("to do"));
}

TEST(DiagnoseVerb, WritesEveryFileItIsAskedFor) {
  const TempFolder folder;
  const AppResult result =
      RunApp(kVerb + kQuick + "--quiet --json '" + folder.Path("d.json") + "' --extend '" +
             folder.Path("e.json") + "' --answers '" + folder.Path("a.json") + "' --plot '" +
             folder.Path("d.svg") + "'");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(json::parse(FileText(folder.Path("d.json"))).contains("verdict"));
  EXPECT_TRUE(json::parse(FileText(folder.Path("e.json"))).contains("parameters"));
  EXPECT_TRUE(json::parse(FileText(folder.Path("a.json"))).contains("rtc_france"));
  EXPECT_THAT(FileText(folder.Path("d.svg")), HasSubstr("</svg>"));
}

// With several files, each gets its line of results or its error.
TEST(DiagnoseVerb, GoesOnBehindAFileThatCannotBeRead) {
  const std::string files = "diagnose no_such_file.csv '" + DataFolder("rtc_france") + "' ";
  const AppResult text = RunApp(files + kQuick);
  EXPECT_EQ(text.exit_code, 1);
  EXPECT_THAT(text.err, HasSubstr("no_such_file.csv"));
  EXPECT_THAT(text.out, StartsWith("rtc_france: "));
  const json j = json::parse(RunApp(files + kQuick + "--json -").out, nullptr, false);
  ASSERT_TRUE(j.is_array());
  EXPECT_EQ(j.size(), 1U);
}

TEST(DiagnoseVerb, ExplainsEveryEffectOfTheList) {
  std::istringstream list(RunApp("diagnose --list").out);
  std::string line, id;
  int effects = 0;
  std::getline(list, line);  // the header
  while (std::getline(list, line) && std::istringstream(line) >> id && id != "lyrefit") {
    const AppResult result = RunApp("diagnose --explain " + id);
    EXPECT_EQ(result.exit_code, 0) << id << result.err;
    EXPECT_THAT(result.out, HasSubstr("(" + id + ")"));
    ++effects;
  }
  EXPECT_GT(effects, 20);
}

TEST(DiagnoseVerb, WritesWholeDiagnosesAsJson) {
  const json j = json::parse(RunApp(kVerb + "--folds 4 --json -").out, nullptr, false);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["points"]["voltage_V"].size(), 26U);
  EXPECT_GT(j["trials"].size(), 20U);
  EXPECT_TRUE(j["verdict"]["causes"].is_array());
}

// Table of a cell of 8 A whose photocurrent steps up during the sweep.
std::string CurveWithAStep() {
  std::string text = "voltage,current\n";
  for (int k = 0; k < 40; ++k) {
    const double voltage = 0.0155 * k;
    const double noise = 0.003 * std::sin(1.7 * k * k + 0.3 * k);
    const double current = (k < 17 ? 7.8 : 8.0) - 1.2e-8 * std::expm1(voltage / 0.0308);
    text += std::to_string(voltage) + "," + std::to_string(current + noise) + "\n";
  }
  return text;
}

TEST(DiagnoseVerb, ExtendsTheModelByItsCauses) {
  const TempFolder folder;
  std::ofstream(folder.Path("step.csv")) << CurveWithAStep();
  const std::string verb = "diagnose '" + folder.Path("step.csv") +
                           "' --temperature-C 25 --effects irr_step --no-held-out ";
  const json fit = json::parse(RunApp(verb + "--extend -").out, nullptr, false);
  ASSERT_TRUE(fit.is_object());
  const std::string parameters = fit["parameters"].dump();
  for (const char* name : {"photocurrent", "resistance_series", "irr_step.s"}) {
    EXPECT_THAT(parameters, HasSubstr(name));
  }
  EXPECT_EQ(fit["causes"], json({"irr_step"}));
  std::ofstream(folder.Path("extended.json")) << fit;
  ExpectSameCurve(folder.Path("extended.json"), fit);
  const json answers = json::parse(RunApp(verb + "--answers -").out, nullptr, false);
  ASSERT_TRUE(answers.is_object());
  EXPECT_THAT(answers["step"].dump(), HasSubstr("irr_step"));
}

TEST(DiagnoseVerb, RepeatsItself) {
  const std::string verb = kVerb + kQuick + "--seed 3 --json - ";
  json one = json::parse(RunApp(verb + "--threads 1").out, nullptr, false);
  json two = json::parse(RunApp(verb + "--threads 2").out, nullptr, false);
  ASSERT_TRUE(one.is_object());
  RemoveSeconds(&one);
  RemoveSeconds(&two);
  EXPECT_EQ(one, two);
}

TEST(DiagnoseVerb, WritesTheCausesAsATable) {
  SKIP_IF_SANITIZED();
  const std::string shaded = DataFolder("diagnosis") + "/shaded_module.csv";
  const AppResult result = RunApp("diagnose '" + shaded + "' --no-held-out --csv -");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, ::testing::StartsWith("measurement,cause,title,named,current_effect,"));
  EXPECT_THAT(result.out, ::testing::HasSubstr("\nshaded_module,shading,partial shading,yes,0.00"));
  const AppResult clean =
      RunApp("diagnose '" + DataFolder("rtc_france") + "' --effects clip --no-held-out --csv -");
  EXPECT_THAT(clean.out, ::testing::HasSubstr("\nrtc_france,,,no,,,,,,,,,,,,,"));
}

TEST(DiagnoseVerb, EchoesItsBaseItsEffectsAndThatNothingIsHeldOut) {
  const AppResult result = RunApp("diagnose '" + DataFolder("rtc_france") +
                                  "' --base dd --effects clip,drift --no-held-out --json -");
  const auto options = nlohmann::json::parse(result.out, nullptr, false)["non_default_options"];
  std::map<std::string, std::string> echoed;
  for (const auto& option : options) echoed[option["name"]] = option["value"];
  EXPECT_EQ(echoed, (std::map<std::string, std::string>{
                        {"base", "dd"}, {"effects", "clip,drift"}, {"held-out", "no"}}));
}

}  // namespace
}  // namespace lyrefit
