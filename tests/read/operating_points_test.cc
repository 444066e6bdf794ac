#include "lyrefit/read/operating_points.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lyrefit/read/table_view.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

TEST(ReadOperatingTable, RefusesFilesThatAreMissingOrTooLarge) {
  const TempFolder folder;
  EXPECT_FALSE(ReadOperatingTable(folder.Path("missing.csv"), 1 << 20));
  EXPECT_FALSE(ReadOperatingTable(folder.Write("large.csv", std::string(200, 'x')), 100));
}

using ::testing::HasSubstr;

// A row every quarter of an hour; `voltage` of the row's number.
template <class Voltage>
std::string Log(const std::string& head, const char* time, const Voltage& voltage) {
  std::string text = head + "\n";
  for (int k = 0; k < 40; ++k) {
    text += fmt::format(fmt::runtime(time), 8 + k / 4, 15 * (k % 4));
    text += fmt::format("{},{}\n", voltage(k), 0.2 * k);
  }
  return text;
}

double Wandering(int k) { return 600 + 17 * ((k * 5) % 7); }

TEST(OperatingLogTest, APointARowOverHoursIsTheLogOfADay) {
  for (const char* const head : {"Time,Vpv1(V),Ipv1(A)", "time,U_dc,I_dc", "t,voltage,current"}) {
    const auto found = FindOperatingLog(Log(head, "2024-05-01 {:02}:{:02}:00,", Wandering));
    ASSERT_TRUE(found) << head;
    EXPECT_THAT(*found, HasSubstr("40 readings over 9.8 hours"));
    EXPECT_THAT(*found, HasSubstr("lyrefit trend --operating"));
  }
  EXPECT_TRUE(FindOperatingLog(Log("Date,Time,V,I", "2024-05-01,{:02}:{:02},", Wandering)));
}

TEST(OperatingLogTest, ASweepIsNone) {
  const auto rising = [](int k) { return 15.0 * k; };
  EXPECT_FALSE(FindOperatingLog(Log("Time,V,I", "2024-05-01 {:02}:{:02}:00,", rising)));
  EXPECT_FALSE(FindOperatingLog("V,I\n0,1\n1,0.9\n2,0\n"));
  // The seconds of a sweep: the same wandering voltages within a minute.
  std::string quick = "Time,V,I\n";
  for (int k = 0; k < 40; ++k) {
    quick += fmt::format("2024-05-01 10:00:{:02},{},{}\n", k, Wandering(k), 0.2 * k);
  }
  EXPECT_FALSE(FindOperatingLog(quick));
}

}  // namespace
}  // namespace lyrefit
