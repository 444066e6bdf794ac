#include "lyrefit/report/figure_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(RunGnuplot, ReturnsWhatTheScriptPrints) {
  const auto answer = RunGnuplot("set print '-'\nprint 6 * 7\n");
  ASSERT_TRUE(answer) << answer.error().ToString();
  EXPECT_EQ(*answer, "42\n");
}

TEST(RunGnuplot, ReportsTheFirstComplaint) {
  EXPECT_THAT(MessageOf(RunGnuplot("nonsense here\n")), HasSubstr("could not draw the plot"));
}

TEST(RunGnuplot, RefusesAnEmptyPicture) { EXPECT_FALSE(RunGnuplot("x = 1\n")); }

}  // namespace
}  // namespace lyrefit
