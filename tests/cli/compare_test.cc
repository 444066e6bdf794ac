#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "repeats.h"
#include "run_app.h"
#include "start_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kSmall = " --runs 3 --population 10 --iterations 20 ";

// The commands under the tables of data/paper/README.md, which cmake/results.sh takes from remarks.csv, in short.
TEST(Compare, CommandsUnderTheTablesOfThePublicationRun) {
  const std::string page = FileText(DataFolder("paper") + "/README.md");
  std::istringstream rows(FileText(DataFolder("paper") + "/remarks.csv"));
  const std::string root = DataFolder("paper") + "/../";
  int run = 0;
  for (std::string row; std::getline(rows, row);) {
    static const std::regex kCommand(R"re(^([A-Za-z0-9 ]+): command,"(.*)"$)re");
    std::smatch match;
    if (!std::regex_match(row, match, kCommand)) continue;
    const std::string lines = std::regex_replace(match[2].str(), std::regex(" ; "), "\n");
    EXPECT_THAT(page, HasSubstr("```text\n" + lines + "\n```\n")) << match[1];
    std::istringstream commands(lines);
    for (std::string command; std::getline(commands, command);) {
#ifndef LYREFIT_HAS_PAGMO
      if (command.find("pagmo:") != std::string::npos) continue;
#endif
      command = std::regex_replace(command.substr(8), std::regex(" data/"), " " + root);
      command = std::regex_replace(command, std::regex("--runs [0-9]+"), "--runs 2");
      if (command.rfind("compare", 0) == 0) command += " --population 70 --iterations 3";
      const AppResult result = RunApp(command);
      EXPECT_EQ(result.exit_code, 0) << command << '\n' << result.err;
      ++run;
    }
  }
  EXPECT_GE(run, 14);
}

TEST(CompareVerb, PrintsTheComparisonByDefault) {
  const AppResult result = RunApp("compare " + kRtc + kSmall);
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, StartsWith("lyrefit "));
  EXPECT_THAT(result.out, HasSubstr("6 algorithms, 3 runs each, on 3 problems"));
  EXPECT_THAT(result.out, HasSubstr("rtc_france, triple-diode model, bounds physical"));
  EXPECT_THAT(result.out, HasSubstr("After the polish all 6 algorithms tie: 18 of 18 runs"));
  const std::string help = RunApp("compare --help").out;
  EXPECT_THAT(help, HasSubstr("(default 1000)"));
  EXPECT_THAT(help, Not(HasSubstr("--patience")));
}

TEST(CompareVerb, TakesTheCurvesOfASetThatAreNearestToConditions) {
  const AppResult result = RunApp("compare " + DataFolder("s75_constructed") + kSmall +
                                  "--models sd --algorithms lo,mlo --bounds paper "
                                  "--curves 6 --at 950x25,200x26");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("All curves: RMSE in A"));
  const std::size_t first = result.out.find("s75_constructed/6 (1000 W/m2, 50 C)");
  const std::size_t second = result.out.find("s75_constructed/1 (1000 W/m2, 25 C)");
  const std::size_t third = result.out.find("s75_constructed/5 (200 W/m2, 25 C)");
  EXPECT_LT(first, second) << result.out;
  EXPECT_LT(second, third) << result.out;
  EXPECT_NE(third, std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("s75_constructed/2 "), std::string::npos);
}

TEST(CompareVerb, GivesTheSameJsonOnAnyNumberOfThreads) {
  const std::string arguments = kRtc + kSmall + "--models sd,dd --seed 5 --plain-polish";
  json one = CompareJson(arguments + " --threads 1");
  json two = CompareJson(arguments + " --threads 2");
  RemoveSeconds(&one);
  RemoveSeconds(&two);
  EXPECT_EQ(one, two) << json::diff(one, two).dump();
}

TEST(CompareVerb, GoesByTheFlags) {
  SKIP_IF_SANITIZED();
  const json j = CompareJson(kRtc + " " + DataFolder("pwp201") +
                             " --runs 2 --models dd --algorithms mlo,de --population 12 "
                             "--iterations 15 --memory-rate 0.75 --de-scale 0.6 --seed 9 "
                             "--objective solved-current --constants literature --bounds wide "
                             "--target-gap 0.5 --no-polish");
  ASSERT_EQ(j["problems"].size(), 2U);
  EXPECT_EQ(j["problems"][1]["curve"], "pwp201");
  EXPECT_EQ(j["problems"][0]["model"], "dd");
  EXPECT_EQ(j["problems"][0]["bounds"], "wide");
  EXPECT_EQ(j["objective"], "solved-current");
  EXPECT_EQ(j["constants"], "literature");
  EXPECT_EQ(j["seed"], 9);
  EXPECT_EQ(j["target_gap"], 0.5);
  EXPECT_EQ(j["polish"], false);
  const json& mlo = j["problems"][0]["algorithms"][0];
  EXPECT_EQ(mlo["name"], "mlo");
  EXPECT_EQ(mlo["runs"].size(), 2U);
  EXPECT_EQ(mlo["settings"]["population"], 12);
  EXPECT_EQ(mlo["settings"]["memory_rate"], 0.75);
  EXPECT_TRUE(mlo["refined"].is_null());
  const json& de = j["problems"][0]["algorithms"][1];
  EXPECT_EQ(de["settings"]["de_scale"], 0.6);
  EXPECT_EQ(de["runs"][0]["evaluations"], 12 * 16);
}

TEST(CompareVerb, ConditionsReplaceThoseOfTheCurve) {
  const std::string common = kRtc + kSmall + "--models sd --algorithms random";
  const json told = CompareJson(common + " --temperature-C 60");
  const json plain = CompareJson(common);
  const char* n = "/problems/0/reference/parameters/n";
  EXPECT_LT(told.at(json::json_pointer(n)), plain.at(json::json_pointer(n)));
}

TEST(CompareVerb, AgreesWithASingleFit) {
  const json j = CompareJson(kRtc + kSmall + "--models dd --algorithms mlo --seed 4");
  const json fit = FitJson(kRtc +
                           " --model dd --objective measured-current --population 10 "
                           "--iterations 20 --seed 4 --run 2");
  const json& run = j["problems"][0]["algorithms"][0]["runs"][2];
  EXPECT_EQ(run["searched_A"], fit["rmse"]["searched"]["measured_current_A"]);
  EXPECT_EQ(run["refined_A"], fit["rmse"]["refined"]["measured_current_A"]);
}

TEST(CompareVerb, WritesEveryFile) {
  const TempFolder folder;
  const AppResult result =
      RunApp("compare " + kRtc + kSmall + "--models sd --json " + folder.Path("c.json") +
             " --csv " + folder.Path("c.csv") + " --plot " + folder.Path("box.svg") +
             " --convergence-plot " + folder.Path("course.png"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, StartsWith("lyrefit "));
  EXPECT_TRUE(json::accept(FileText(folder.Path("c.json"))));
  EXPECT_THAT(FileText(folder.Path("c.csv")), StartsWith("curve,model,objective,bounds,"));
  EXPECT_THAT(FileText(folder.Path("box.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(FileText(folder.Path("course.png")), StartsWith("\x89PNG"));
}

TEST(CompareVerb, PutsTheTableOfRunsAloneOnStandardOutput) {
  const AppResult result =
      RunApp("compare " + kRtc + kSmall + "--models sd --algorithms mlo --csv -");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 1 + 3);
}

TEST(CompareVerb, EndsCleanlyBeforeItsFirstRunIsDone) {
  const TempFolder folder;
  ShownApp app({"compare", kRtc, "--models", "sd", "--algorithms", "mlo", "--population", "1000",
                "--iterations", "1000000", "--json", folder.Path("c.json"), "--plot",
                folder.Path("box.svg")},
               folder.Path("out.txt"));
  app.AwaitShown("compare \\[.*\\] 0 of");
  kill(app.child(), SIGTERM);
  EXPECT_EQ(app.ExitCode(), 130) << app.shown();
  EXPECT_THAT(FileText(folder.Path("out.txt")), StartsWith("INTERRUPTED"));
  const json j = json::parse(FileText(folder.Path("c.json")), nullptr, false);
  ASSERT_TRUE(j.is_object());
  EXPECT_EQ(j["interrupted"], true);
  EXPECT_TRUE(j["problems"].empty());
}

}  // namespace
}  // namespace lyrefit
