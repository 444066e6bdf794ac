#include "lyrefit/batch/count_rows.h"

#include <gtest/gtest.h>

namespace lyrefit {
namespace {

TEST(CountRows, KeepsTheFirstOfAKindAndNotTooManyKinds) {
  const std::vector<ResultColumn> columns = {{"status", "", CellType::kText, ""},
                                             {"reason", "", CellType::kText, ""},
                                             {"where", "", CellType::kText, ""}};
  RowCounter counter(columns);
  for (int i = 0; i < 3 * kMostReasons; ++i) {
    const std::string kind(1 + i % (2 * kMostReasons), 'x');
    counter.Count({{std::string("broken"), kind, "row " + std::to_string(i)}});
  }
  BatchCounts summary = counter.counts();
  EXPECT_EQ(summary.rows, 3 * kMostReasons);
  EXPECT_EQ(summary.statuses["broken"], 3 * kMostReasons);
  EXPECT_EQ(summary.reasons.size(), kMostReasons + 1U);
  EXPECT_EQ(summary.reasons["x"].where, "row 0");
  EXPECT_EQ(summary.reasons["x"].rows, 2);
}

}  // namespace
}  // namespace lyrefit
