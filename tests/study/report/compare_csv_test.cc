#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "sample_comparison.h"

namespace lyrefit {
namespace {

using ::testing::StartsWith;

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(CompareCsv, HasOneRowARun) {
  const auto lines = Lines(CompareCsv(SampleComparison()));
  ASSERT_EQ(lines.size(), 1U + 2 * 3 * 4);
  EXPECT_EQ(
      lines[0],
      "curve,model,objective,bounds,algorithm,run,seed,searched_A,plain_polished_A,"
      "refined_best_candidate_A,refined_A,evaluations,curve_evaluations,evaluations_to_target,"
      "search_seconds,"
      "refine_seconds");
  EXPECT_THAT(lines[1], StartsWith("sample_cell,sd,measured-current,literature,mlo,0,7,"
                                   "0.00098602187789,"));
  EXPECT_THAT(lines[24], StartsWith("sample_cell,dd,measured-current,literature,random,3,7,"));
  for (const std::string& line : lines) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 15);
}

TEST(CompareCsv, LeavesFieldsEmptyThatAreNotKnown) {
  Comparison comparison = SampleComparison();
  comparison.problems.pop_back();
  RunRecord& run = comparison.problems[0].algorithms[0].runs[0];
  run = {};
  run.evaluations = 5;
  run.curve_evaluations = 9;
  EXPECT_EQ(Lines(CompareCsv(comparison))[1],
            "sample_cell,sd,measured-current,literature,mlo,0,7,,,,,5,9,,0,0");
}

TEST(CompareCsv, QuotesNamesWithCommas) {
  Comparison comparison = SampleComparison();
  comparison.problems[0].curve_name = "roof, \"east\"";
  EXPECT_THAT(Lines(CompareCsv(comparison))[1], StartsWith("\"roof, \"\"east\"\"\",sd,"));
}

}  // namespace
}  // namespace lyrefit
