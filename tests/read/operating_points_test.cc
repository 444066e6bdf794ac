#include "lyrefit/read/operating_points.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/table_view.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

TEST(ReadOperatingTable, RefusesFilesThatAreMissingOrTooLarge) {
  const TempFolder folder;
  EXPECT_FALSE(ReadOperatingTable(folder.Path("missing.csv"), 1 << 20));
  EXPECT_FALSE(ReadOperatingTable(folder.Write("large.csv", std::string(200, 'x')), 100));
}

std::string Points(const std::vector<std::string>& dates) {
  std::string text = "time,irradiance,temperature,vmp,imp\n";
  for (const std::string& date : dates) text += date + ",800,40,30,7\n";
  return text;
}

TEST(ReadOperatingTable, TellsDayFromMonthByAllDatesAndCountsRowsWithoutOne) {
  const TempFolder folder;
  const auto read = [&](const std::vector<std::string>& dates) {
    return ReadOperatingTable(folder.Write("a.csv", Points(dates)), 1 << 20);
  };
  const auto day_first = read({"03/04/2025 10:00", "yesterday", "13/04/2025 10:00"});
  ASSERT_TRUE(day_first) << day_first.error().ToString();
  ASSERT_EQ(day_first->size(), 3U);
  EXPECT_EQ(DateText((*day_first)[0].time_s), "2025-04-03");
  EXPECT_TRUE(std::isnan((*day_first)[1].time_s));
  const auto month_first = read({"03/04/2025 10:00", "03/14/2025 10:00"});
  ASSERT_TRUE(month_first) << month_first.error().ToString();
  EXPECT_EQ(DateText((*month_first)[0].time_s), "2025-03-04");
  EXPECT_FALSE(read({"03/04/2025 10:00", "04/04/2025 10:00"}));
  EXPECT_FALSE(read({"13/04/2025 10:00", "03/14/2025 10:00"}));
  EXPECT_FALSE(read({"yesterday", "2025-04-13 10:00"}));
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
