#include "lyrefit/read/operating_points.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "error_of.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/read/table_view.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

constexpr std::int64_t kLargest = 1 << 20;

TEST(ReadOperatingTable, TakesColumnsInAnyOrderByTheirNames) {
  const TempFolder folder;
  const std::pair<const char*, const char*> tables[] = {
      {"date,irradiance_Wm2,temperature_C,vmp_V,imp_A", "2025-03-12 10:30,812.5,41.5,30.25,7.5"},
      {"imp,vmp,temperature_C,irradiance,time", "7.5,30.25,41.5,812.5,2025-03-12 10:30"},
      {"Timestamp;V_mp (V);I_mp (A);Irradiance (W/m2);Cell temperature (C);inverter",
       "12.03.2025 10:30;30.25;7.5;812.5;41.5;north"},
      {"tmst\tVdc\tIdc\tPOA irradiance (W/m2)\tmodule_temperature_C",
       "2025-03-12T10:30\t30.25\t7.5\t812.5\t41.5"},
      {"DateTime,Voltage (V),Current (A),irradiance_W_m2,temperature_C",
       "\"2025-03-12 10:30\",30.25,7.5,812.5,41.5"},
  };
  for (const auto& [header, row] : tables) {
    const std::string path =
        folder.Write("points.csv", std::string("# logger 7\n") + header + "\n" + row + "\n");
    const auto points = ReadOperatingTable(path, kLargest);
    ASSERT_TRUE(points) << header << ": " << points.error().ToString();
    ASSERT_EQ(points->size(), 1U) << header;
    const OperatingReading& point = points->front();
    EXPECT_EQ(point.time_s, *ReadDateTime("2025-03-12 10:30")) << header;
    EXPECT_EQ(point.irradiance_W_m2, 812.5) << header;
    EXPECT_EQ(point.temperature_C, 41.5) << header;
    EXPECT_EQ(point.voltage_V, 30.25) << header;
    EXPECT_EQ(point.current_A, 7.5) << header;
  }
}

TEST(ReadOperatingTable, AnInputOfAnInverterIsNamed) {
  const TempFolder folder;
  const std::string path = folder.Write(
      "log.csv",
      "Serial number,Time,Vpv1(V),Vpv2(V),Ipv1(A),Ipv2(A),irradiance_Wm2,temperature_C\n"
      "7,2025-03-12 10:30,600,610,7,8,812,41\n");
  EXPECT_THAT(MessageOf(ReadOperatingTable(path, kLargest)),
              ::testing::HasSubstr("choose one with --column"));
  const auto points = ReadOperatingTable(path, kLargest, "2");
  ASSERT_TRUE(points) << points.error().ToString();
  EXPECT_EQ(points->front().voltage_V, 610);
  EXPECT_EQ(points->front().current_A, 8);
  const std::string bare = folder.Write("bare.csv",
                                        "No,Time,Status,Vpv1(V),Ipv1(A)\n"
                                        "7,2025-03-12 10:30,on,600,7\n");
  EXPECT_THAT(MessageOf(ReadOperatingTable(bare, kLargest)),
              ::testing::HasSubstr("found none for irradiance: a trend compares each row"));
}

TEST(ReadOperatingTable, ConvertsUnits) {
  const TempFolder folder;
  const std::string path = folder.Write("points.csv",
                                        "time,irradiance (kW/m2),temperature_C,vmp (mV),imp (mA)\n"
                                        "2025-03-12 10:30,0.8,41,30250,7500\n");
  const auto points = ReadOperatingTable(path, kLargest);
  ASSERT_TRUE(points) << points.error().ToString();
  EXPECT_NEAR(points->front().irradiance_W_m2, 800, 1e-9);
  EXPECT_NEAR(points->front().voltage_V, 30.25, 1e-12);
  EXPECT_NEAR(points->front().current_A, 7.5, 1e-12);
}

TEST(ReadOperatingTable, KeepsRowsWithMissingValues) {
  const TempFolder folder;
  const std::string path = folder.Write("points.csv",
                                        "time,irradiance,temperature,vmp,imp\n"
                                        "2025-03-12 10:30,,41,30,7\n"
                                        "2025-03-12 10:40,800,NA,30,7\n"
                                        "2025-03-12 10:50,800,41, null ,7\n"
                                        "2025-03-12 11:00,800,41,30,error\n"
                                        "\n"
                                        "2025-03-12 11:10,800,41,30,7\n");
  const auto points = ReadOperatingTable(path, kLargest);
  ASSERT_TRUE(points) << points.error().ToString();
  ASSERT_EQ(points->size(), 5U);
  EXPECT_TRUE(std::isnan((*points)[0].irradiance_W_m2));
  EXPECT_TRUE(std::isnan((*points)[1].temperature_C));
  EXPECT_TRUE(std::isnan((*points)[2].voltage_V));
  EXPECT_TRUE(std::isnan((*points)[3].current_A));
  EXPECT_EQ((*points)[4].current_A, 7);
}

TEST(ReadOperatingTable, NamesTheColumnThatIsMissing) {
  const TempFolder folder;
  const std::pair<const char*, const char*> headers[] = {
      {"irradiance,temperature,vmp,imp,x", "none for time"},
      {"time,temperature,vmp,imp,x", "none for irradiance"},
      {"time,irradiance,vmp,imp,x", "none for temperature"},
      {"time,irradiance,temperature,imp,x", "none for vmp"},
      {"time,irradiance,temperature,vmp,power_W", "none for imp"},
      {"time,irradiance", "none for time"},
  };
  for (const auto& [header, complaint] : headers) {
    const std::string path =
        folder.Write("points.csv", std::string("# a logger\n") + header + "\n1,2,3,4,5\n");
    ExpectErrorAt(ReadOperatingTable(path, kLargest), path, 2, 1, complaint);
  }
}

TEST(ReadOperatingTable, PointsAtWhatIsNoNumberAndNoDate) {
  const TempFolder folder;
  const std::string head = "time,irradiance,temperature,vmp,imp\n2025-03-12 10:30,800,41,30,7\n";
  std::string path = folder.Write("points.csv", head + "noon,800,41,30,7\n");
  ExpectErrorAt(ReadOperatingTable(path, kLargest), path, 3, 1,
                "expected a date such as 2025-03-12 10:30");
  path = folder.Write("points.csv", head + "2025-03-12 10:40,800,41,thirty,7\n");
  ExpectErrorAt(ReadOperatingTable(path, kLargest), path, 3, 25, "thirty");
  path = folder.Write("points.csv", head + "2025-03-12 10:40,800,41\n");
  const auto torn = ReadOperatingTable(path, kLargest);
  ASSERT_FALSE(torn);
  EXPECT_EQ(torn.error().line, 3);
}

TEST(ReadOperatingTable, RefusesFilesWithoutATable) {
  const TempFolder folder;
  EXPECT_EQ(MessageOf(ReadOperatingTable(folder.Write("empty.csv", ""), kLargest)),
            "the file is empty");
  EXPECT_EQ(MessageOf(ReadOperatingTable(folder.Write("remarks.csv", "# a\n\n# b\n"), kLargest)),
            "the file holds no data, only blank lines and comments");
  EXPECT_FALSE(ReadOperatingTable(folder.Path("missing.csv"), kLargest));
  const std::string large = folder.Write("large.csv", std::string(200, 'x'));
  EXPECT_FALSE(ReadOperatingTable(large, 100));
}

TEST(ReadOperatingTable, OfAHeaderAloneIsEmpty) {
  const TempFolder folder;
  const auto points = ReadOperatingTable(
      folder.Write("points.csv", "time,irradiance,temperature,vmp,imp\n"), kLargest);
  ASSERT_TRUE(points);
  EXPECT_TRUE(points->empty());
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
