#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cases.h"
#include "read/told.h"
#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::StartsWith;

std::vector<std::string> FilesIn(const TempFolder& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.Path(""))) {
    names.push_back(entry.path().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void Replace(const std::string& what, const std::string& with, std::string* text) {
  for (std::size_t at = 0; (at = text->find(what, at)) != std::string::npos; at += with.size()) {
    text->replace(at, what.size(), with);
  }
}

// The sentence that refuses a command line; @ is the folder of its files, $DATA that of the data. No
// file may be written.
std::string RefusalOf(const std::string& given) {
  const TempFolder folder;
  std::string arguments = WithFiles(given, folder);
  Replace("@", folder.Path(""), &arguments);
  Replace("$DATA", LYREFIT_DATA_DIR, &arguments);
  const auto before = FilesIn(folder);
  const AppResult result = RunApp(arguments);
  EXPECT_EQ(result.exit_code, 1) << arguments;
  EXPECT_EQ(result.out, "") << arguments;
  EXPECT_THAT(result.err, StartsWith("lyrefit: ")) << arguments;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(FilesIn(folder), before) << arguments;
  std::string sentence = Without(folder, result.err.substr(0, result.err.find('\n')));
  Replace(LYREFIT_DATA_DIR, "$DATA", &sentence);
  if (arguments.rfind("fit ", 0) == 0) {
    EXPECT_LT(sentence.size(), 400U) << sentence;
  }
  return sentence;
}

TEST(BadInput, IsRefusedWithOneSentence) { CheckCases("cli_refusals", {{"command", RefusalOf}}); }

TEST(BadInput, IsRefusedWhereItIsHugeOrBinaryAndWhereNothingCanBeWritten) {
  const TempFolder folder;
  std::string binary =
      "\x7f"
      "ELF";
  for (int i = 0; i < 5000; ++i) binary += static_cast<char>(i * 37 % 256);
  const std::string huge = folder.Write("huge.csv", FileText(kRtc + "/curve.csv"));
  std::filesystem::resize_file(huge, 200U << 20);
  ExpectRefusals("fit ", {{huge + " --json " + folder.Path("out.json"), "larger"},
                          {folder.Write("binary.csv", binary), "binary"},
                          {kRtc + " --json /proc/out.json", "/proc/out.json"}});
}

// Sentences of the library that parses flags, or of this processor.
TEST(BadInput, NamesTheFlagThatIsWrong) {
  ExpectRefusals("fit " + kRtc + " ", {{"--cells 1.5", "--cells"},
                                       {"--iterations abc", "--iterations"},
                                       {"--nonsense", "--nonsense"},
                                       {"--kernel sse", "portable"},
                                       {"--temperature-C 47,3", "point: 47.3)"},
                                       {"--family cec --temperature-accuracy 99", "accuracy: "},
                                       {"--family desoto --folds -1", "--folds: "},
                                       {"--family desoto --search-curves 1", "--search-curves: "},
                                       {"--threads -3", "--threads: "}});
  ExpectRefusals("compare " + kRtc + " ", {{"--runs many", "--runs"},
                                           {"--threads -3", "--threads: "},
                                           {"--threads 5000", "--threads: "}});
  ExpectRefusals("diagnose " + kRtc, {{" --threads -3", "--threads: "}});
  ExpectRefusals("datasheet --isc 4.75 --cells 0", {{"", "--cells"}});
}

}  // namespace
}  // namespace lyrefit
