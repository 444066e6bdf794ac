#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "repeats.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kCurve = "'" + DataFolder("rtc_france") + "' ";

TEST(Verbs, AreFoundByWhatIsAskedOfThem) {
  const AppResult bare = RunApp("");
  EXPECT_EQ(bare.exit_code, 0) << bare.err;
  EXPECT_EQ(bare.err, "");
  EXPECT_EQ(bare.out, RunApp("help").out);
  for (const char* verb : {"fit", "simulate", "certify", "compare", "datasheet", "audit",
                           "diagnose", "cell", "pack"}) {
    EXPECT_THAT(bare.out, HasSubstr(std::string("\n  ") + verb + " ")) << verb;
    EXPECT_THAT(bare.out, HasSubstr(std::string(" lyrefit ") + verb + " ")) << verb;
  }
}

TEST(Verbs, HelpOfOneIsTheSameTwoWays) {
  EXPECT_EQ(RunApp("help fit").out, RunApp("fit --help").out);
}

TEST(Verbs, TermsFitATerminalAndCoverTheTables) {
  const std::string terms = RunApp("help terms").out;
  EXPECT_EQ(RunApp("--help terms").out, terms);
  EXPECT_EQ(RunApp("--help fit").out, RunApp("fit --help").out);
  std::istringstream lines(terms);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100U) << line;
  for (const char* term : {"Isc", "Rsh", "n1", "AICc", "probability", "misfit", "kept", "floor",
                           "searched", "refined", "std err", "95 % interval"}) {
    EXPECT_THAT(terms, HasSubstr(term));
  }
}

// Every long flag in the help text.
std::vector<std::string> FlagsIn(const std::string& help) {
  std::vector<std::string> flags;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("  --", 0) == 0) flags.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return flags;
}

TEST(Verbs, ManualAndCompletionKnowEveryFlag) {
  const AppResult manual = RunApp("man");
  EXPECT_THAT(manual.out, StartsWith(".TH LYREFIT 1 "));
  const std::string bash = RunApp("completion bash").out;
  const std::string zsh = RunApp("completion zsh").out;
  const std::string fish = RunApp("completion fish").out;
  const std::vector<std::string> flags = FlagsIn(RunApp("diagnose --help").out);
  EXPECT_GT(flags.size(), 30U);
  for (const std::string& flag : flags) {
    EXPECT_THAT(bash, AnyOf(HasSubstr(" " + flag + " "), HasSubstr(" " + flag + "'"))) << flag;
    EXPECT_THAT(zsh, HasSubstr("'*" + flag + "[")) << flag;
    EXPECT_THAT(fish, HasSubstr(" -l " + flag.substr(2) + " ")) << flag;
    std::string roff;
    for (const char c : flag) roff += c == '-' ? "\\-" : std::string(1, c);
    EXPECT_THAT(manual.out, HasSubstr("\\fB" + roff + "\\fR")) << flag;
  }
  EXPECT_THAT(fish, HasSubstr("-a 'sd dd td auto'"));
}

TEST(Verbs, BashCompletesVerbsFlagsAndValues) {
  const TempFolder folder;
  const std::string script = folder.Path("complete.bash");
  std::ofstream(script) << RunApp("completion bash").out;
  const auto complete = [&](const std::string& words, int count) {
    const std::string out = folder.Path("out");
    const std::string command = "bash -c 'source " + script + "; COMP_WORDS=(" + words +
                                "); COMP_CWORD=" + std::to_string(count) +
                                "; _lyrefit; echo ${COMPREPLY[@]}' > " + out;
    EXPECT_EQ(std::system(command.c_str()), 0) << words;
    return FileText(out);
  };
  EXPECT_EQ(complete("lyrefit diag", 1), "diagnose\n");
  EXPECT_EQ(complete("lyrefit fit --mod", 2), "--model\n");
  EXPECT_EQ(complete("lyrefit fit --model a", 3), "auto\n");
  EXPECT_EQ(complete("lyrefit completion f", 2), "fish\n");
}

TEST(Verbs, HelpThatCannotBeWrittenIsAnError) {
  for (const char* arguments : {"", "--help", "fit --help", "--version", "help terms", "man"}) {
    const std::string command =
        "'" + std::string(LYREFIT_APP) + "' " + arguments + " > /dev/full 2>/dev/null";
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1) << arguments;
  }
}

TEST(Verbs, ThatPrintAReportKnowQuiet) {
  SKIP_IF_SANITIZED();
  const AppResult audit = RunApp("audit '" + DataFolder("paper") + "/rows.csv' --quiet");
  EXPECT_EQ(audit.exit_code, 0) << audit.err;
  EXPECT_EQ(audit.out, "");
  const AppResult compare = RunApp("compare " + kCurve +
                                   "--models sd --algorithms random --runs 2 --iterations 5 "
                                   "--population 10 --quiet");
  EXPECT_EQ(compare.exit_code, 0) << compare.err;
  EXPECT_EQ(compare.out, "");
}

}  // namespace
}  // namespace lyrefit
