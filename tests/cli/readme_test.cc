// Every command of the README that can be run with what ships is run. Left out are synopses (they
// hold brackets or CAPITALS for what is to be filled in) and what the README itself says needs
// other data or takes its time, in a comment on its line: "# needs ...", "# takes ...".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "cli/run_app.h"

namespace lyrefit {
namespace {

struct ReadmeCommand {
  int line = 0;
  std::string arguments;
};

bool IsToBeRun(const std::string& command) {
  static const std::regex kFilledIn(
      R"([\[\]|]|\.\.\.|\b(CURVE|SET|ROWS|FILE|FIT)\b|=[A-Z]\b| [A-Z]\b)");
  static const std::regex kLeftOut("# (needs|takes) ");
  return !std::regex_search(command, kFilledIn) && !std::regex_search(command, kLeftOut);
}

std::vector<ReadmeCommand> CommandsOf(const std::string& path) {
  static const std::string kStart = "    lyrefit ";
  std::ifstream file(path);
  std::vector<ReadmeCommand> commands;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const int first = number;
    for (std::string more; !line.empty() && line.back() == '\\' && std::getline(file, more);) {
      ++number;
      line.pop_back();
      line += more;
    }
    const bool is_output = line.find("lyrefit 0.") != std::string::npos;
    if (line.rfind(kStart, 0) != 0 || is_output || !IsToBeRun(line)) continue;
    commands.push_back({first, line.substr(kStart.size(), line.find(" #") - kStart.size())});
  }
  return commands;
}

TEST(Readme, CommandsRunWithWhatShips) {
  const TempFolder folder;
  const std::filesystem::path project = std::filesystem::path(LYREFIT_DATA_DIR).parent_path();
  std::filesystem::copy(project / "data", folder.Path("data"),
                        std::filesystem::copy_options::recursive);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path(""));
  const std::vector<ReadmeCommand> commands = CommandsOf((project / "README.md").string());
  EXPECT_GE(commands.size(), 8U);
  for (const ReadmeCommand& command : commands) {
    const AppResult result = RunApp(command.arguments);
    EXPECT_EQ(result.exit_code, 0)
        << "README.md:" << command.line << ": " << command.arguments << '\n'
        << result.err;
  }
  std::filesystem::current_path(before);
}

TEST(Readme, ShowsTheEffectOfOnesOwnThatIsCompiled) {
  const std::filesystem::path project = std::filesystem::path(LYREFIT_DATA_DIR).parent_path();
  const auto text = [&](const char* file) {
    std::ifstream stream(project / file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::string example = text("tests/package/own_effect.cc");
  EXPECT_GT(example.size(), 500U);
  EXPECT_NE(text("README.md").find("```cpp\n" + example + "```"), std::string::npos);
}

TEST(Readme, LeavesOutSynopsesAndWhatItSaysCannotBeRun) {
  EXPECT_FALSE(IsToBeRun("    lyrefit fit CURVE... [--model sd]"));
  EXPECT_FALSE(IsToBeRun("    lyrefit datasheet --isc A --voc V"));
  EXPECT_FALSE(IsToBeRun("    lyrefit fit case1.json --family free  # needs those sets"));
  EXPECT_TRUE(IsToBeRun("    lyrefit fit data/rtc_france --json fit.json"));
}

}  // namespace
}  // namespace lyrefit
