#include "lyrefit/read/read_cell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lyrefit/curve/dark.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

constexpr char kDarkAndLit[] =
    "Vd,Jd,Vl,Jl\n0,0,0,-0.0210\n0.3,1e-6,0.3,-0.0205\n0.5,1e-4,0.5,-0.0190\n"
    "0.6,2e-3,0.6,-0.0120\n0.7,2e-2,0.7,0.0050\n";

TEST(ReadCellTest, DarkAndLitPairsOfLettersAreOneCell) {
  const TempFolder folder;
  const std::string file = folder.Write("a.csv", kDarkAndLit);
  ReadOptions options;
  options.area_cm2 = 0.1;
  options.current_unit = "A/cm2";
  const auto cell = ReadCell({file}, options);
  ASSERT_TRUE(cell) << cell.error().ToString();
  ASSERT_EQ(cell->curves.size(), 2U);
  EXPECT_TRUE(IsStatedDark(cell->curves[0]));
  EXPECT_NEAR(cell->curves[1].current_A[0], 2.1e-3, 1e-12);
}

TEST(ReadCellTest, ACellWithoutItsLitCurveIsRefused) {
  const TempFolder folder;
  const std::string file = folder.Write("a.csv", kDarkAndLit);
  ReadOptions options;
  options.area_cm2 = 0.1;
  const auto cell = ReadCell({file}, options);
  ASSERT_FALSE(cell);
  EXPECT_THAT(cell.error().message, testing::HasSubstr("--current-unit A/cm2"));
}

}  // namespace
}  // namespace lyrefit
