#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(BudgetVerb, PrintsHitsByAlgorithmAndBudget) {
  const AppResult result = RunApp("budget " + kRtc +
                                  " --models sd --runs 3 --budgets 10,100,1000 "
                                  "--algorithms mlo,random");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("algorithm  10  100  1000"));
  EXPECT_THAT(result.out, HasSubstr("All starts (hybrid), runs of 3 within 1e-9"));
  EXPECT_THAT(result.out, HasSubstr("Random points do as well as any search."));
}

TEST(BudgetVerb, SpendsTheBudgetExactlyAndPolishesPlainlyToo) {
  const AppResult result = RunApp("budget " + kRtc +
                                  " --models dd --runs 2 --budgets 50,17 --algorithms de,random "
                                  "--json -");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json j = json::parse(result.out, nullptr, false);
  const json& algorithms = j["problems"][0]["algorithms"];
  ASSERT_EQ(algorithms.size(), 4U);
  EXPECT_EQ(algorithms[1]["name"], "de@17");
  EXPECT_EQ(algorithms[1]["algorithm"], "de");
  EXPECT_EQ(algorithms[1]["settings"]["max_evaluations"], 17);
  for (const json& compared : algorithms) {
    for (const json& run : compared["runs"]) {
      EXPECT_EQ(run["evaluations"], compared["settings"]["max_evaluations"]);
      EXPECT_TRUE(run["plain_polished_A"].is_number());
    }
  }
  EXPECT_TRUE(j["problems"][0]["ranking"]["searched"].is_null());
}

TEST(BudgetVerb, DrawsThePicture) {
  const TempFolder folder;
  const AppResult result =
      RunApp("budget " + kRtc + " --models sd --runs 2 --budgets 10,100 --algorithms mlo,random" +
             " --plot " + folder.Path("budget.svg"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(FileText(folder.Path("budget.svg")), HasSubstr("Evaluations of the search"));
}

TEST(BudgetVerb, RefusesBadBudgets) {
  for (const char* budgets : {"3", "10,x", "10.5", "10,,20", "1e12"}) {
    const AppResult result = RunApp("budget " + kRtc + " --budgets " + budgets);
    EXPECT_EQ(result.exit_code, 1) << budgets;
    EXPECT_THAT(result.err, HasSubstr("--budgets")) << budgets;
  }
  EXPECT_THAT(RunApp("budget " + kRtc + " --budgets 10,10").err, HasSubstr("lo@10 is named twice"));
}

}  // namespace
}  // namespace lyrefit
