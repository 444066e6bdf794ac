#include "lyrefit/read/table_layout.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "error_of.h"
#include "lyrefit/read/cells.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/read_curve_set.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// Rows of devices a and b, one after the other; that of b ends at `part` of the voltages of a.
std::string RowsOfTwo(const std::string& name, double part = 1) {
  std::string rows = name + ",Voltage (V),Current (A)\n";
  for (const auto& [device, most] : {std::pair("a", 1.0), {"b", part}}) {
    for (int k = 0; k <= 20; ++k) {
      const double voltage = 0.03 * k * most;
      rows += fmt::format("{},{},{}\n", device, voltage,
                          0.04 - (device[0] - 'a') * 0.01 - 0.08 * voltage * voltage);
    }
  }
  return rows;
}

TEST(DeviceColumnTest, AValueOfAColumnOfDevicesIsADevice) {
  const TempFolder folder;
  for (const char* const name : {"Channel", "Pixel No.", "DUT ID", "sample", "Cell", "string"}) {
    const auto set = ReadMeasurement(folder.Write("rows.csv", RowsOfTwo(name)));
    ASSERT_TRUE(set) << name;
    ASSERT_EQ(set->curves.size(), 2U) << name;
    EXPECT_TRUE(set->several_devices);
    EXPECT_NEAR(set->curves[0].current_A[0], 0.04, 1e-12);
    EXPECT_NEAR(set->curves[1].current_A[0], 0.03, 1e-12);
    EXPECT_THAT(MessageOf(CheckIsOneCell(*set, "batch")),
                HasSubstr("a, " + set->curves[1].name + "): choose one with --column NAME"));
  }
}

TEST(DeviceColumnTest, OneIsChosenByNameOrPlace) {
  const std::string text = RowsOfTwo("Channel");
  for (const char* const wish : {"b", "2"}) {
    ReadOptions options;
    options.column = wish;
    const auto curve = ReadCurveText(text, "rows", options);
    ASSERT_TRUE(curve) << wish;
    EXPECT_NEAR(curve->current_A[0], 0.03, 1e-12) << wish;
  }
  ReadOptions none;
  none.column = "c";
  EXPECT_THAT(MessageOf(ReadCurveText(text, "rows", none)), HasSubstr("'a', 'b'"));
  EXPECT_THAT(MessageOf(ReadCurveText(text, "rows")), HasSubstr("expected one device, found 2"));
}

TEST(DeviceColumnTest, OtherColumnsAndPartsOfASweepAreNone) {
  const TempFolder folder;
  for (const std::string& rows : {RowsOfTwo("Range"), RowsOfTwo("Channel", 0.2)}) {
    const auto set = ReadMeasurement(folder.Write("rows.csv", rows));
    EXPECT_FALSE(set && set->several_devices);
  }
}

}  // namespace
}  // namespace lyrefit
