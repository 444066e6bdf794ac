#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_app.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(PaperProgram, WritesThePageItsPicturesAndTheBlocksOfOtherPages) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  const std::string other =
      folder.Write("other.md", "a\n<!-- ranked -->\n<!-- end of ranked -->\nb\n");
  const AppResult result =
      RunApp("'" + DataFolder("paper") + "' --out '" + folder.Path("") + "' --update '" + other +
             "' --batch 2 --batches 2 --sensitivity-batches 2 --ranked-runs 2 --budget-runs 1 "
             "--iterations 30 --peers gwo --pwp201-runs 1 --pwp201-budgets 1 --proof-effort 10 "
             "--sound-problems 2 --sound-effort 10 --wide-problems 2");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = FileText(folder.Path("README.md"));
  EXPECT_THAT(page, HasSubstr("## Table 12"));
  EXPECT_THAT(page, HasSubstr("9.82485E-04"));
  EXPECT_THAT(page, HasSubstr("| rtc_france | [1, 2] |"));
  EXPECT_THAT(page, HasSubstr("40 rows"));
  EXPECT_THAT(page, HasSubstr("| s75_constructed/200x25, sd | lo | mean | 0.034721 |"));
  EXPECT_THAT(page, HasSubstr("| s75_constructed/1000x60 | mlo |"));
  EXPECT_THAT(FileText(folder.Path("pwp201.md")), HasSubstr("# Photowatt-PWP201 with two diodes"));
  EXPECT_THAT(FileText(folder.Path("sound.md")), HasSubstr("2 made problems"));
  EXPECT_THAT(FileText(other), HasSubstr("| algorithm | mean rank, search alone |"));
  for (const char* picture : {"msx60.svg", "msx60-convergence.svg", "rtc_france-convergence.svg",
                              "ranked.svg", "ranked-convergence.svg", "budget.svg"}) {
    EXPECT_THAT(FileText(folder.Path(picture)), HasSubstr("</svg>")) << picture;
    EXPECT_THAT(page, HasSubstr(picture));
  }
}

TEST(PaperProgram, RefusesAFolderWithoutThePaper) {
  const TempFolder folder;
  const AppResult result = RunApp("'" + folder.Path("") + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("remarks.csv"));
}

TEST(PaperProgram, RefusesWhatItDoesNotKnow) {
  const std::string paper = "'" + DataFolder("paper") + "' ";
  const struct {
    std::string arguments;
    const char* says;
  } cases[] = {
      {paper + "--threads -3", "--threads: expected a whole number from 0 to 1024, found '-3'"},
      {paper + "--batch 2.5", "--batch: expected a whole number from 2 to 1000000, found '2.5'"},
      {paper + "--batch", "--batch: expected a value behind it"},
      {paper + "--candidates 3", "unknown flag --candidates"},
      {paper + "more", "expected one folder, found 'more' as well"},
      {"--batch 3", "expected the paper's folder"},
  };
  for (const auto& one : cases) {
    const AppResult result = RunApp(one.arguments);
    EXPECT_EQ(result.exit_code, 1) << one.arguments;
    EXPECT_EQ(result.out, "") << one.arguments;
    EXPECT_THAT(result.err, HasSubstr(one.says)) << one.arguments;
  }
}

}  // namespace
}  // namespace lyrefit
