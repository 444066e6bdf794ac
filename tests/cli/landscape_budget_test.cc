#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "../repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSmallLandscape =
    "budget --landscape strings_2,td_wide --devices 2 --algorithms shape,mlo,random "
    "--budgets 10,40 --multistart 2 ";

// Without the keys named seconds.
json Timeless(json value) {
  if (value.is_object()) value.erase("seconds");
  for (auto& child : value) {
    if (child.is_structured()) child = Timeless(child);
  }
  return value;
}

// `count` columns of every line, from column `from` on.
std::string Columns(const std::string& csv, std::size_t from, std::size_t count) {
  std::string kept;
  std::size_t column = 0;
  for (const char letter : csv) {
    if (column >= from && column < from + count) kept += letter;
    if (letter == ',') ++column;
    if (letter == '\n') column = 0;
  }
  return kept;
}

TEST(LandscapeBudget, SumsUpTheDevicesOfEachProblem) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const AppResult result = RunApp(kSmallLandscape + "--json " + folder.Path("a.json") + " --csv " +
                                  folder.Path("a.csv"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("Which search, from which budget, or none\n  strings_2: "));
  EXPECT_THAT(result.out, HasSubstr("starts from the curve's shape alone hit "));
  EXPECT_THAT(result.out,
              HasSubstr("best candidate: hits of 2 runs, median time of a run (solved-"));
  EXPECT_THAT(result.out,
              HasSubstr("best candidate: hits of 2 runs, median time of a run (measured-"));
  EXPECT_THAT(result.out, HasSubstr("All problems, 4 blocks"));
  EXPECT_THAT(result.out, Not(HasSubstr("nan")));
  const json j = json::parse(FileText(folder.Path("a.json")), nullptr, false);
  EXPECT_EQ(j["problems"].size(), 4U) << "every device";
  EXPECT_EQ(j["problems"][0]["problem"], "strings_2");
  EXPECT_EQ(j["problems"][0]["objective"], "solved-current");
  EXPECT_EQ(j["problems"][0]["reference"]["multistart"]["random_points"], 2);
  EXPECT_EQ(j["problems"][3]["objective"], "measured-current");
  const json& pools = j["pools"]["problems"];
  ASSERT_EQ(pools.size(), 2U);
  EXPECT_EQ(pools[0]["problem"], "strings_2");
  EXPECT_EQ(pools[0]["devices"], 2);
  EXPECT_EQ(pools[1]["certified"], 2) << "three diodes, measured current";
  ASSERT_EQ(pools[0]["algorithms"].size(), 5U);
  EXPECT_EQ(pools[0]["algorithms"][0]["kind"], "shape");
  EXPECT_TRUE(pools[0]["algorithms"][0]["searched"].is_null());
  for (const json& compared : pools[0]["algorithms"]) {
    const json& level = compared["refined"];
    EXPECT_EQ(level["runs"], 2);
    const int missed = level.contains("failures") ? int(level["failures"]["runs"]) : 0;
    EXPECT_EQ(int(level["hits"]) + missed, 2);
    EXPECT_GE(double(level["excess"]["min"]), 0);
  }
  EXPECT_THAT(pools[0]["answer"]["seconds"]["sentence"].get<std::string>(),
              testing::StartsWith("strings_2: "));
  EXPECT_EQ(j["pools"]["rankings"].size(), 6U) << "all and two problems, two budgets each";
  const std::string csv = FileText(folder.Path("a.csv"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 * 5);
  EXPECT_THAT(csv,
              HasSubstr("refine_seconds,problem,reference_A,plain_seconds,best_candidate_seconds"));
  EXPECT_THAT(csv, HasSubstr("strings_2 1,sd,solved-current,"));
}

TEST(LandscapeBudget, HasTheSameBitsOnAnyThreadsAndWhenTakenUp) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const auto run = [&](const std::string& flags, const std::string& name) {
    const AppResult result =
        RunApp(kSmallLandscape + flags + " --json " + folder.Path(name + ".json") + " --csv " +
               folder.Path(name + ".csv"));
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Timeless(json::parse(FileText(folder.Path(name + ".json")), nullptr, false));
  };
  const json whole = run("--threads 1", "one");
  const std::string journal = "--resume " + folder.Path("study.jsonl");
  EXPECT_EQ(run("--threads 3 " + journal, "three"), whole);
  EXPECT_EQ(run("--threads 2 " + journal, "again"), whole);
  EXPECT_EQ(FileText(folder.Path("again.csv")), FileText(folder.Path("three.csv")))
      << "seconds too: they are those of the runs";
  EXPECT_EQ(Columns(FileText(folder.Path("one.csv")), 0, 14),
            Columns(FileText(folder.Path("three.csv")), 0, 14));
  const AppResult other = RunApp(kSmallLandscape + "--seed 2 " + journal);
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.err, HasSubstr("this study was begun with"));
}

TEST(LandscapeBudget, DrawsARowOfPanelsAProblem) {
  const TempFolder folder;
  const AppResult result = RunApp(
      "budget --landscape strings_2 --devices 1 --algorithms shape,random --budgets 10,40 "
      "--multistart 0 --plot " +
      folder.Path("budget.svg"));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string picture = FileText(folder.Path("budget.svg"));
  for (const char* panel : {"strings_2: search alone", "strings_2: all starts"}) {
    EXPECT_THAT(picture, HasSubstr(panel));
  }
}

TEST(LandscapeBudget, RefusesWhatDoesNotGoTogether) {
  const auto refusal = [](const std::string& flags) {
    const AppResult result = RunApp("budget " + flags);
    EXPECT_EQ(result.exit_code, 1) << flags;
    return result.err;
  };
  EXPECT_THAT(refusal("--budgets 10"), HasSubstr("CURVE is required, or --landscape"));
  EXPECT_THAT(refusal(DataFolder("rtc_france") + " --landscape strings_2"),
              HasSubstr("goes without CURVE"));
  EXPECT_THAT(refusal("--landscape strings_2 --models sd"),
              HasSubstr("--models: every problem of --landscape has its own"));
  EXPECT_THAT(refusal("--landscape strings_2,strings_2"), HasSubstr("strings_2 is named twice"));
  EXPECT_THAT(refusal("--landscape caves"), HasSubstr("strings_2"));
  EXPECT_THAT(refusal("--landscape strings_2 --algorithms tabu"),
              HasSubstr("shape, default or pagmo:NAME"));
}

}  // namespace
}  // namespace lyrefit
