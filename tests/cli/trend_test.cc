#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kTrendYear = "'" + DataFolder("trend") + "/year.csv'";
const std::string kTrendPoints = "'" + DataFolder("trend") + "/operating.csv'";
const std::string kTrendModule = "--module '" + DataFolder("trend") + "/module.json'";

bool HasOnset(const json& trend, const std::string& cause, const std::string& from,
              const std::string& until) {
  return std::any_of(trend["onsets"].begin(), trend["onsets"].end(), [&](const json& onset) {
    const std::string date = onset["date"];
    return onset["cause"] == cause && from <= date && date <= until;
  });
}

double EnergyLostBy(const json& trend, const std::string& part) {
  return trend["loss"]["energy_percent"][part]["value"];
}

// data/trend/about.md says what is hidden.
TEST(TrendCommand, FindsWhatHappenedInTheYear) {
  const json trend = AnswerJson("trend " + kTrendYear);
  ASSERT_TRUE(trend.is_object());
  EXPECT_EQ(trend["name"], "year");
  EXPECT_EQ(trend["source"], "sweeps");
  EXPECT_EQ(trend["cells_in_series"], 60);
  EXPECT_EQ(trend["substrings"], 3);
  EXPECT_EQ(trend["measurements"], 356);
  EXPECT_TRUE(HasOnset(trend, "1 of 3 substrings without voltage", "2025-06-11", "2025-06-22"));
  EXPECT_TRUE(HasOnset(trend, "a step of the series resistance", "2025-08-27", "2025-09-08"));
  EXPECT_NEAR(EnergyLostBy(trend, "mismatch"), 18.4, 1);
  EXPECT_NEAR(EnergyLostBy(trend, "light"), 1, 1.5);
  EXPECT_NEAR(EnergyLostBy(trend, "resistance_series"), 0.4, 0.5);
  EXPECT_NEAR(EnergyLostBy(trend, "recombination"), 0, 0.5);
  EXPECT_NEAR(EnergyLostBy(trend, "shunt"), 0, 0.5);
}

TEST(TrendCommand, FindsItInOperatingPoints) {
  const json trend =
      AnswerJson("trend --operating " + kTrendPoints + " " + kTrendModule + " --bypass-diodes 3");
  ASSERT_TRUE(trend.is_object());
  EXPECT_EQ(trend["source"], "operating points");
  EXPECT_EQ(trend["law"], "module.json");
  EXPECT_EQ(trend["measurements"], 1664);
  EXPECT_GT(trend["states"]["off maximum"].get<int>(), 10);
  EXPECT_LT(trend["states"]["off maximum"].get<int>(), 30);
  EXPECT_TRUE(HasOnset(trend, "1 of 3 substrings without voltage", "2025-06-13", "2025-06-17"));
  EXPECT_TRUE(HasOnset(trend, "a step of the series resistance", "2025-08-25", "2025-09-14"));
  EXPECT_NEAR(EnergyLostBy(trend, "mismatch"), 18.4, 1);
}

TEST(TrendCommand, WritesEveryOutput) {
  const TempFolder folder;
  const AppResult run = RunApp("trend " + kTrendYear + " --csv '" + folder.Path("t.csv") +
                               "' --json '" + folder.Path("t.json") + "' --html '" +
                               folder.Path("t.html") + "' --plot '" + folder.Path("t.svg") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("trend of year"));
  EXPECT_THAT(run.out, HasSubstr("Losses against the reference"));
  EXPECT_THAT(FileText(folder.Path("t.csv")), StartsWith("time,p_mp_percent,light_percent,"));
  EXPECT_TRUE(json::accept(FileText(folder.Path("t.json"))));
  EXPECT_THAT(FileText(folder.Path("t.html")), HasSubstr("substrings without voltage"));
  EXPECT_THAT(FileText(folder.Path("t.svg")), HasSubstr("</svg>"));
  const AppResult brief = RunApp("trend " + kTrendYear + " --brief");
  EXPECT_THAT(brief.out, StartsWith("year: Against its first days"));
  EXPECT_EQ(std::count(brief.out.begin(), brief.out.end(), '\n'), 1);
}

TEST(TrendCommand, SaysTheSameOnAnyNumberOfThreads) {
  const AppResult one = RunApp("trend " + kTrendYear + " --threads 1 --json -");
  const AppResult two = RunApp("trend " + kTrendYear + " --threads 2 --json -");
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
}

TEST(TrendCommand, AppendsOnceAndReportsFromTheState) {
  const TempFolder folder;
  const std::string state = folder.Path("year.state");
  const AppResult first = RunApp("trend " + kTrendYear + " --append '" + state + "'");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("356 of 356 appended to "));
  const std::string content = FileText(state);
  const AppResult again = RunApp("trend " + kTrendYear + " --append '" + state + "'");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("0 of 356 appended to "));
  EXPECT_EQ(FileText(state), content);
  const AppResult of_state = RunApp("trend '" + state + "' --json -");
  EXPECT_EQ(of_state.exit_code, 0) << of_state.err;
  EXPECT_EQ(of_state.out, RunApp("trend " + kTrendYear + " --json -").out);
}

TEST(TrendCommand, SaysWhatOneMoreSweepShows) {
  const TempFolder folder;
  const std::string state = folder.Path("year.state");
  ASSERT_EQ(RunApp("trend " + kTrendYear + " --append '" + state + "'").exit_code, 0);
  const std::string year = FileText(DataFolder("trend") + "/year.csv");
  const std::string head = year.substr(0, year.find('\n') + 1);
  std::string last = year.substr(year.rfind('\n', year.size() - 2) + 1);
  last.replace(0, 4, "2026");
  const std::string today = folder.Write("today.csv", head + last);
  const AppResult run = RunApp("trend '" + today + "' --append '" + state + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, StartsWith("2026-12-28 "));
  EXPECT_THAT(run.out, HasSubstr(" W, light "));
  EXPECT_THAT(run.out, HasSubstr("1 of the substrings without voltage"));
  EXPECT_THAT(run.out, HasSubstr("1 of 1 appended to "));
}

TEST(TrendCommand, KeepsOperatingPointsInAState) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const std::string state = folder.Path("points.state");
  const std::string points = "trend --operating " + kTrendPoints + " " + kTrendModule;
  const AppResult first = RunApp(points + " --append '" + state + "'");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.out, HasSubstr("1664 of 1664 appended to "));
  const AppResult again = RunApp(points + " --append '" + state + "'");
  EXPECT_THAT(again.out, HasSubstr("0 of 1664 appended to "));
  EXPECT_EQ(RunApp("trend '" + state + "' --json -").out, RunApp(points + " --json -").out);
}

TEST(TrendCommand, HelpNamesItsFlags) {
  const AppResult help = RunApp("trend --help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* flag : {"--operating", "--module", "--append", "--reference-days",
                           "--false-alarms", "--bypass-diodes", "--json", "--html", "130"}) {
    EXPECT_THAT(help.out, HasSubstr(flag));
  }
}

TEST(TrendCommand, RefusesADamagedState) {
  const TempFolder folder;
  const std::string state = folder.Path("year.state");
  ASSERT_EQ(RunApp("trend " + kTrendYear + " --append '" + state + "'").exit_code, 0);
  std::string content = FileText(state);
  const std::size_t second = content.find('\n') + 1;
  content.replace(second, 1, "x");
  const std::string damaged = folder.Write("damaged.state", content);
  ExpectRefusals("trend ", {{"'" + damaged + "'", "damaged.state:2"},
                            {kTrendYear + " --append '" + damaged + "'", "damaged.state:2"}});
  EXPECT_EQ(FileText(damaged), content);
}

TEST(TrendCommand, RefusesWhatAStateIsNotOf) {
  const TempFolder folder;
  const std::string state = "'" + folder.Path("year.state") + "'";
  ASSERT_EQ(RunApp("trend " + kTrendYear + " --append " + state).exit_code, 0);
  const std::string content = FileText(folder.Path("year.state"));
  const std::string append = " --append " + state;
  ExpectRefusals(
      "trend ",
      {{"--operating " + kTrendPoints + " " + kTrendModule + append, "this state is of sweeps"},
       {kTrendYear + " " + kTrendModule + append, "follows a device by another law"},
       {kTrendYear + " --cells 72" + append, "--cells 72: the law of this state has 60"},
       {kTrendYear + " --bypass-diodes 6" + append, "the law of this state has 3"},
       {state + " --cells 72", "--cells 72: the law of this state has 60"},
       {state + " " + kTrendYear, "the state of a trend is read alone"},
       {state + append, "this run reads the file"},
       {state + append + " --force", "the state of a trend is read alone"},
       {kTrendYear + append + " --json '" + folder.Path("t.json") + "'",
        "--append writes no report"},
       {kTrendYear + " --append ''", "--append: expected the name of a file"}});
  EXPECT_EQ(FileText(folder.Path("year.state")), content);
  EXPECT_EQ(RunApp("trend " + kTrendYear + " --cells 60" + append).exit_code, 0);
}

}  // namespace
}  // namespace lyrefit
