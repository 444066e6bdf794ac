#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "lyrefit/study/truth.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TruthComparison SampleTruth() {
  TruthComparison comparison;
  comparison.rows = 1;
  comparison.curves = 50;
  comparison.one_truth = true;
  TruthParameter p;
  p.info.symbol = "Rsh";
  p.worst = 0.25;
  p.worst_id = "17";
  p.median = 0.031;
  p.intervals = 50;
  p.covered = 48;
  p.truth = 3000;
  p.mean = 2991.5;
  p.mean_error = -0.00283;
  p.root_mean_square = 0.05;
  comparison.parameters = {p};
  return comparison;
}

TEST(TruthText, ShowsBothTablesOfOneDevice) {
  const std::string text = TruthText(SampleTruth());
  EXPECT_THAT(text, HasSubstr("Truth (one device): 50 curves fitted alone"));
  EXPECT_THAT(text, HasSubstr("2.50e-01  17"));
  EXPECT_THAT(text, HasSubstr("48 of 50"));
  EXPECT_THAT(text, HasSubstr("-2.83e-03"));
  EXPECT_THAT(text, HasSubstr("as a conductance"));
}

TEST(TruthText, LeavesOutWhatIsNotThere) {
  TruthComparison comparison = SampleTruth();
  comparison.rows = 32;
  comparison.one_truth = false;
  comparison.unmatched = 2;
  comparison.parameters[0].intervals = 0;
  comparison.warnings = {"the truth is of one diode"};
  const std::string text = TruthText(comparison);
  EXPECT_THAT(text, HasSubstr("Truth (32 rows)"));
  EXPECT_THAT(text, Not(HasSubstr("conductance")));
  EXPECT_THAT(text, HasSubstr("2 curves without a row of truth"));
  EXPECT_THAT(text, HasSubstr("! the truth is of one diode."));
  comparison.parameters.clear();
  EXPECT_THAT(TruthText(comparison), Not(HasSubstr("worst")));
}

}  // namespace
}  // namespace lyrefit
