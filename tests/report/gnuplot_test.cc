#include "lyrefit/report/figure_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(RunGnuplot, ReturnsWhatTheScriptPrints) {
  const auto answer = RunGnuplot("set print '-'\nprint 6 * 7\n");
  ASSERT_TRUE(answer) << answer.error().ToString();
  EXPECT_EQ(*answer, "42\n");
}

TEST(RunGnuplot, ReportsTheFirstComplaint) {
  const auto answer = RunGnuplot("nonsense here\n");
  ASSERT_FALSE(answer);
  EXPECT_THAT(answer.error().message, HasSubstr("could not draw the plot"));
}

TEST(RunGnuplot, RefusesAnEmptyPicture) { EXPECT_FALSE(RunGnuplot("x = 1\n")); }

}  // namespace
}  // namespace lyrefit
