#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kRtc = "'" + DataFolder("rtc_france") + "' ";

TEST(Verbs, ThatAreNoneNameTheNearest) {
  const struct {
    const char* word;
    const char* says;
  } cases[] = {
      {"fti", "no verb 'fti'; did you mean fit?"},
      {"Fit", "no verb 'Fit'; did you mean fit?"},
      {"diagnoze x.csv", "no verb 'diagnoze'; did you mean diagnose?"},
      {"sim --set Iph=1", "no verb 'sim'; did you mean simulate?"},
      {"-v comprae", "no verb 'comprae'; did you mean compare?"},
      {"frobnicate", "no verb 'frobnicate': expected fit, simulate, certify, "},
      {"-v", "expected a verb: fit, simulate, certify, "},
  };
  for (const auto& one : cases) {
    const AppResult result = RunApp(one.word);
    EXPECT_EQ(result.exit_code, 1) << one.word;
    EXPECT_EQ(result.out, "") << one.word;
    EXPECT_THAT(result.err, StartsWith(std::string("lyrefit: ") + one.says)) << one.word;
  }
}

TEST(Verbs, AreListedWhereNothingIsAsked) {
  const AppResult bare = RunApp("");
  EXPECT_EQ(bare.exit_code, 1);
  EXPECT_EQ(bare.out, "");
  EXPECT_THAT(bare.err, HasSubstr(RunApp("--help").out));
  EXPECT_THAT(bare.err, EndsWith("diagnose\n"));
}

TEST(Verbs, HelpThatCannotBeWrittenIsAnError) {
  for (const char* arguments : {"--help", "fit --help", "--version"}) {
    const std::string command =
        "'" + std::string(LYREFIT_APP) + "' " + arguments + " > /dev/full 2>/dev/null";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
  }
}

TEST(Verbs, RefuseNumbersThatCountNothing) {
  const TempFolder folder;
  const std::string cases[] = {
      "fit " + kRtc + "--threads -3",         "diagnose " + kRtc + "--threads -3",
      "compare " + kRtc + "--threads -3",     "budget " + kRtc + "--threads 5000",
      "sensitivity " + kRtc + "--threads -1", "coverage --threads -3",
      "compare " + kRtc + "--runs -1",        "compare " + kRtc + "--runs 0",
      "compare " + kRtc + "--seed -1",        "simulate --set Iph=1 --points -5",
      "coverage --set Iph=8 --cells -3",      "fit " + kRtc + "--loss-scale -1",
      "certify " + kRtc + "--cells -1",
  };
  for (const std::string& arguments : cases) {
    const AppResult result = RunApp(arguments);
    EXPECT_EQ(result.exit_code, 1) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_THAT(result.err, StartsWith("lyrefit: ")) << arguments;
  }
}

TEST(Verbs, ThatPrintAReportKnowQuiet) {
  for (const char* verb : {"fit", "certify", "diagnose", "compare", "budget", "sensitivity",
                           "datasheet", "audit", "coverage"}) {
    EXPECT_THAT(RunApp(std::string(verb) + " --help").out, HasSubstr("--quiet")) << verb;
  }
  const AppResult audit = RunApp("audit '" + DataFolder("paper") + "/rows.csv' --quiet");
  EXPECT_EQ(audit.exit_code, 0) << audit.err;
  EXPECT_EQ(audit.out, "");
  const AppResult compare = RunApp("compare " + kRtc +
                                   "--models sd --algorithms random --runs 2 --iterations 5 "
                                   "--population 10 --quiet");
  EXPECT_EQ(compare.exit_code, 0) << compare.err;
  EXPECT_EQ(compare.out, "");
}

}  // namespace
}  // namespace lyrefit
