#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_app.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(ReproduceVerb, WritesThePageItsPicturesAndTheBlocksOfOtherPages) {
  const TempFolder folder;
  const std::string other =
      folder.Write("other.md", "a\n<!-- ranked -->\n<!-- end of ranked -->\nb\n");
  const AppResult result = RunApp(
      "reproduce '" + DataFolder("paper") + "' --out '" + folder.Path("") + "' --update '" + other +
      "' --batch 2 --batches 2 --sensitivity-batches 2 --ranked-runs 2 --budget-runs 1 "
      "--iterations 30 --peers gwo");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = FileText(folder.Path("README.md"));
  EXPECT_THAT(page, HasSubstr("## Table 12"));
  EXPECT_THAT(page, HasSubstr("9.82485E-04"));
  EXPECT_THAT(page, HasSubstr("| rtc_france | [1, 2] |"));
  EXPECT_THAT(page, HasSubstr("40 rows"));
  EXPECT_THAT(page, HasSubstr("| s75_constructed/200x25, sd | lo | mean | 0.034721 |"));
  EXPECT_THAT(page, HasSubstr("| s75_constructed/1000x60 | mlo |"));
  EXPECT_THAT(FileText(other), HasSubstr("| algorithm | mean rank, search alone |"));
  for (const char* picture : {"msx60.svg", "msx60-convergence.svg", "rtc_france-convergence.svg",
                              "ranked.svg", "ranked-convergence.svg", "budget.svg"}) {
    EXPECT_THAT(FileText(folder.Path(picture)), HasSubstr("</svg>")) << picture;
    EXPECT_THAT(page, HasSubstr(picture));
  }
}

TEST(ReproduceVerb, RefusesAFolderWithoutThePaper) {
  const TempFolder folder;
  const AppResult result = RunApp("reproduce '" + folder.Path("") + "'");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("remarks.csv"));
}

}  // namespace
}  // namespace lyrefit
