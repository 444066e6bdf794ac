// Runs every command of the README and of the pages it links to, and checks the output shown below
// each. Left out are synopses, which hold brackets or CAPITALS as placeholders. Left out are also
// commands with a comment "# needs ..." or "# takes a minute" on their line; those with "# takes
// seconds" are run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "cli/run_app.h"
#include "repeats.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

// A command, and the lines shown below it, which are its output or a part of it ("..." for the
// rest).
struct ReadmeCommand {
  int line = 0;
  std::string arguments;
  std::vector<std::string> shown;
};

fs::path Project() { return fs::path(LYREFIT_DATA_DIR).parent_path(); }

bool StartsWith(const std::string& line, const std::string& start) {
  return line.rfind(start, 0) == 0;
}

bool IsToBeRun(const std::string& command) {
  static const std::regex kFilledIn(
      R"([\[\]|]|\.\.\.|\b(CURVE|SET|ROWS|FILE|FIT|NAME)\b|=[A-Z]\b| [A-Z]\b)");
  static const std::regex kLeftOut("# (needs|takes (?!(some )?seconds)) ?");
  return !std::regex_search(command, kFilledIn) && !std::regex_search(command, kLeftOut);
}

std::vector<ReadmeCommand> CommandsOf(std::istream& page) {
  static const std::string kIndent = "    ";
  static const std::string kStart =
      kIndent + "lyrefit ";  // of a command; of a report, a version follows
  std::vector<ReadmeCommand> commands;
  bool shows = false;  // indented lines belong to the last command
  int number = 0;
  for (std::string line; std::getline(page, line);) {
    const int first = ++number;
    for (std::string more; !line.empty() && line.back() == '\\' && std::getline(page, more);) {
      ++number;
      line.pop_back();
      line += more;
    }
    if (line.empty()) continue;
    if (!StartsWith(line, kIndent)) {
      shows = false;
    } else if (StartsWith(line, kStart) && std::isalpha(line[kStart.size()]) != 0) {
      shows = IsToBeRun(line);
      if (!shows) continue;
      commands.push_back({first, line.substr(kStart.size(), line.find(" #") - kStart.size()), {}});
    } else if (shows && line != kIndent + "...") {
      commands.back().shown.push_back(line);
    }
  }
  return commands;
}

std::vector<std::string> WordsOf(const std::string& line) {
  std::istringstream words(line);
  return {std::istream_iterator<std::string>(words), {}};
}

// Numbers may differ in their last digits, which depend on the processor and the compiler.
bool IsTheSameWord(const std::string& one, const std::string& other) {
  constexpr double kTolerance = 0.01;
  char* end_of_one = nullptr;
  char* end_of_other = nullptr;
  const double a = std::strtod(one.c_str(), &end_of_one);
  const double b = std::strtod(other.c_str(), &end_of_other);
  if (*end_of_one != '\0' || *end_of_other != '\0') return one == other;
  return std::abs(a - b) <= kTolerance * std::abs(a);
}

bool Prints(const std::string& output, const std::string& line) {
  const std::vector<std::string> expected = WordsOf(line);
  std::istringstream lines(output);
  for (std::string printed; std::getline(lines, printed);) {
    const std::vector<std::string> words = WordsOf(printed);
    if (std::equal(words.begin(), words.end(), expected.begin(), expected.end(), IsTheSameWord)) {
      return true;
    }
  }
  return false;
}

class Page : public ::testing::TestWithParam<const char*> {};

TEST_P(Page, CommandsRunWithWhatShipsAndPrintWhatIsShown) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  fs::copy(Project() / "data", folder.Path("data"), fs::copy_options::recursive);
  std::ifstream page(Project() / GetParam());
  const std::vector<ReadmeCommand> commands = CommandsOf(page);
  EXPECT_FALSE(commands.empty());
  const auto before = fs::current_path();
  fs::current_path(folder.Path(""));
  for (const ReadmeCommand& command : commands) {
    const AppResult result = RunApp(command.arguments);
    EXPECT_EQ(result.exit_code, 0)
        << GetParam() << ':' << command.line << ": " << command.arguments << '\n'
        << result.err;
    for (const std::string& line : command.shown) {
      EXPECT_TRUE(Prints(result.out, line))
          << GetParam() << ':' << command.line << ": " << command.arguments << "\ndoes not print\n"
          << line;
    }
  }
  fs::current_path(before);
}

constexpr const char* kPages[] = {"README.md",
                                  "apps/lyrefit/verbs/audit.md",
                                  "apps/lyrefit/verbs/batch.md",
                                  "apps/lyrefit/verbs/cell.md",
                                  "apps/lyrefit/verbs/certify.md",
                                  "apps/lyrefit/verbs/cite.md",
                                  "apps/lyrefit/verbs/compare.md",
                                  "apps/lyrefit/verbs/diagnose.md",
                                  "apps/lyrefit/verbs/family.md",
                                  "apps/lyrefit/verbs/fit.md",
                                  "apps/lyrefit/verbs/inspect.md",
                                  "apps/lyrefit/verbs/simulate.md",
                                  "apps/lyrefit/verbs/translate.md",
                                  "apps/lyrefit/verbs/trend.md",
                                  "apps/lyrefit/verbs/walks.md",
                                  "data/README.md",
                                  "data/json.md",
                                  "data/diagnosis/README.md",
                                  "data/field/README.md",
                                  "data/formats/README.md",
                                  "data/landscapes/README.md",
                                  "data/published/README.md",
                                  "lib/lyrefit/effects/README.md",
                                  "lib/lyrefit/family/README.md",
                                  "lib/lyrefit/estimate/fit/README.md"};

INSTANTIATE_TEST_SUITE_P(Readme, Page, ::testing::ValuesIn(kPages),
                         [](const ::testing::TestParamInfo<const char*>& page) {
                           std::string name = page.param;
                           std::replace_if(
                               name.begin(), name.end(),
                               [](char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

// All pages, with paths relative to the project.
std::vector<fs::path> AllPages() {
  std::vector<fs::path> pages = {"README.md"};
  for (const char* part : {".github", "apps", "data", "lib", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(Project() / part)) {
      if (entry.path().extension() != ".md") continue;
      pages.push_back(fs::relative(entry.path(), Project()));
    }
  }
  return pages;
}

TEST(Readme, EveryPageWithCommandsToBeRunIsAmongThoseRun) {
  for (const fs::path& path : AllPages()) {
    std::ifstream page(Project() / path);
    const bool listed =
        std::find(std::begin(kPages), std::end(kPages), path.string()) != std::end(kPages);
    EXPECT_TRUE(listed || CommandsOf(page).empty()) << path;
  }
}

// What a newcomer copies, in the order of the page and in one folder: none is left out above.
TEST(Readme, EveryCommandOfTheFirstPageIsRun) {
  std::ifstream page(Project() / "README.md");
  std::string all;
  size_t commands = 0;
  for (std::string line; std::getline(page, line); all += line + '\n') {
    commands +=
        static_cast<size_t>(StartsWith(line, "    lyrefit ") && std::isalpha(line[12]) != 0);
  }
  std::istringstream text(all);
  EXPECT_EQ(CommandsOf(text).size(), commands);
  EXPECT_GE(commands, 2U);
}

// Scripts that take long or need another machine are not run, but they must exist.
TEST(Readme, ScriptsThatPagesCallAreThere) {
  static const std::regex kScript(R"((?:^|[\s'`])((?:cmake|tests|apps)/[\w/.-]+\.(?:sh|py|gp)))");
  int scripts = 0;
  for (const fs::path& path : AllPages()) {
    const std::string text = FileText((Project() / path).string());
    for (std::sregex_iterator script(text.begin(), text.end(), kScript);
         script != std::sregex_iterator(); ++script, ++scripts) {
      EXPECT_TRUE(fs::exists(Project() / (*script)[1].str())) << path << ": " << (*script)[1];
    }
  }
  EXPECT_GE(scripts, 8);
}

// Whether a page has the heading of an anchor such as "#how-it-works", by GitHub's rule for
// anchors.
bool HasHeading(const fs::path& page, const std::string& anchor) {
  std::ifstream file(page);
  for (std::string line; std::getline(file, line);) {
    if (!StartsWith(line, "#")) continue;
    std::string slug;
    for (const char c : line.substr(line.find(' ') + 1)) {
      if (std::isalnum(c) != 0) slug += static_cast<char>(std::tolower(c));
      if (c == ' ' || c == '-') slug += '-';
    }
    if (slug == anchor) return true;
  }
  return false;
}

TEST(Readme, LinksOfEveryPageLeadSomewhere) {
  static const std::regex kLink(R"(\]\(([^)#:\s]*)(?:#([^)\s]*))?\))");
  int links = 0;
  for (const fs::path& path : AllPages()) {
    const fs::path page = Project() / path;
    const std::string text = FileText(page.string());
    for (std::sregex_iterator link(text.begin(), text.end(), kLink); link != std::sregex_iterator();
         ++link, ++links) {
      const std::string to = (*link)[1];
      // Pages of the site name pages that its build makes; tests/site follows those.
      if (StartsWith(to, "/") &&
          StartsWith(page.lexically_relative(Project()).string(), "apps/site/pages/"))
        continue;
      const std::string anchor = (*link)[2];
      const fs::path target = to.empty() ? page : page.parent_path() / to;
      EXPECT_TRUE(fs::exists(target)) << page << ": " << link->str();
      EXPECT_TRUE(anchor.empty() || HasHeading(target, anchor)) << page << ": " << link->str();
    }
  }
  EXPECT_GE(links, 40);
}

// The blocks that cmake/results.sh replaces, and one that stays.
TEST(Readme, TablesThatCommandsWriteStandBetweenTheirMarks) {
  const struct {
    const char* page;
    const char* block;
  } kBlocks[] = {{"apps/lyrefit/verbs/certify.md", "proofs-short"},
                 {"data/README.md", "certified"},
                 {"data/README.md", "proofs"},
                 {"data/field/README.md", "proofs-measured"},
                 {"data/landscapes/README.md", "ranked"},
                 {"data/landscapes/README.md", "budget"},
                 {"data/landscapes/README.md", "landscapes"}};
  for (const auto& [page, block] : kBlocks) {
    const std::string text = FileText((Project() / page).string());
    const auto start = text.find(std::string("<!-- ") + block + " -->\n");
    const auto end = text.find(std::string("<!-- end of ") + block + " -->\n");
    ASSERT_NE(start, std::string::npos) << page << ": " << block;
    ASSERT_NE(end, std::string::npos) << page << ": " << block;
    EXPECT_GT(end, start + 500) << page << ": " << block;
  }
}

TEST(Readme, ShowsTheStudyOfSearchesThatIsRun) {
  const std::string example = FileText((Project() / "apps/python/examples/budgets.py").string());
  const std::string shown = example.substr(example.find("import lyrefit"));
  EXPECT_GT(shown.size(), 500U);
  EXPECT_NE(FileText((Project() / "data/landscapes/README.md").string())
                .find("```python\n" + shown + "```"),
            std::string::npos);
}

TEST(Readme, ShowsTheEffectOfOnesOwnThatIsCompiled) {
  const std::string example = FileText((Project() / "tests/package/own_effect.cc").string());
  EXPECT_GT(example.size(), 500U);
  EXPECT_NE(FileText((Project() / "lib/lyrefit/effects/README.md").string())
                .find("```cpp\n" + example + "```"),
            std::string::npos);
}

TEST(Readme, LeavesOutSynopsesAndWhatItSaysCannotBeRun) {
  EXPECT_FALSE(IsToBeRun("    lyrefit fit CURVE... [--model sd]"));
  EXPECT_FALSE(IsToBeRun("    lyrefit datasheet --isc A --voc V"));
  EXPECT_FALSE(IsToBeRun("    lyrefit fit case1.json --family free  # needs those sets"));
  EXPECT_TRUE(IsToBeRun("    lyrefit fit data/rtc_france --json fit.json"));
}

TEST(Readme, TellsWhatACommandPrintsFromTheNextOne) {
  std::istringstream page(
      "    lyrefit fit a \\\n        --model sd   # a comment\n\n    lyrefit 1.0.0: a\n    ...\n"
      "      n1  1.4\n    lyrefit fit b\n\nText\n    not printed\n    lyrefit fit FILE\n    x\n");
  const std::vector<ReadmeCommand> commands = CommandsOf(page);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(WordsOf(commands[0].arguments), WordsOf("fit a --model sd"));
  EXPECT_EQ(commands[0].shown, (std::vector<std::string>{"    lyrefit 1.0.0: a", "      n1  1.4"}));
  EXPECT_EQ(commands[1].line, 7);
  EXPECT_TRUE(commands[1].shown.empty());
  EXPECT_TRUE(Prints("a\n  n1   1.40001\n", commands[0].shown[1]));
  EXPECT_FALSE(Prints("a\n  n1   1.5\n", commands[0].shown[1]));
  EXPECT_FALSE(Prints("a\n  n2   1.4\n", commands[0].shown[1]));
}

}  // namespace
}  // namespace lyrefit
