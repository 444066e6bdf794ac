#include "lyrefit/batch/count_rows.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(CountRows, TakesSentencesThatDifferInNumbersForOne) {
  EXPECT_EQ(WithoutNumbers("3 points at 12.5 V, expected 5."), "N points at N V, expected N.");
  EXPECT_EQ(WithoutNumbers("expected a number, found 'abc'"), "expected a number, found 'N'");
  EXPECT_EQ(WithoutNumbers("the module's current -1.5e-03 A"), "the module's current -N A");
  EXPECT_EQ(WithoutNumbers(""), "");
}

TEST(CountRows, KeepsTheFirstOfAKindAndNotTooManyKinds) {
  const std::vector<ResultColumn> columns = {{"status", "", CellType::kText, ""},
                                             {"reason", "", CellType::kText, ""},
                                             {"where", "", CellType::kText, ""}};
  BatchSummary summary;
  RowCounter counter(columns, &summary);
  for (int i = 0; i < 3 * kMostReasons; ++i) {
    const std::string kind(1 + i % (2 * kMostReasons), 'x');
    counter.Count({{std::string("broken"), kind, "row " + std::to_string(i)}});
  }
  EXPECT_EQ(summary.rows, 3 * kMostReasons);
  EXPECT_EQ(summary.statuses["broken"], 3 * kMostReasons);
  EXPECT_EQ(summary.reasons.size(), kMostReasons + 1U);
  EXPECT_EQ(summary.reasons["x"].where, "row 0");
  EXPECT_EQ(summary.reasons["x"].rows, 2);
}

}  // namespace
}  // namespace lyrefit
