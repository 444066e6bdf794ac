#include "lyrefit/curve/date_time.h"

#include <gtest/gtest.h>

#include <limits>

namespace lyrefit {
namespace {

constexpr double k12March_s = 20159 * kDay_s;  // 2025-03-12
constexpr double k25March_s = 20172 * kDay_s;
constexpr double kHalfPastTen_s = 10.5 * 3600;

TEST(ReadDateTime, ReadsAllForms) {
  const std::pair<const char*, double> texts[] = {
      {"1970-01-01", 0},
      {"2025-03-12", k12March_s},
      {"\"2025-03-12\"", k12March_s},
      {" 2025-03-12 10:30 ", k12March_s + kHalfPastTen_s},
      {"2025-03-12T10:30:05", k12March_s + kHalfPastTen_s + 5},
      {"2025-03-12T10:30:05.5", k12March_s + kHalfPastTen_s + 5.5},
      {"2025-03-12 10:30:05,25", k12March_s + kHalfPastTen_s + 5.25},
      {"2025/3/12 10:30", k12March_s + kHalfPastTen_s},
      {"2025.03.12", k12March_s},
      {"12.03.2025 10:30", k12March_s + kHalfPastTen_s},
      {"12.3.25", k12March_s},
      {"03/25/2025", k25March_s},
      {"25/03/2025 10:30", k25March_s + kHalfPastTen_s},
      {"3/25/2025 10:30 PM", k25March_s + 22.5 * 3600},
      {"3/25/2025 12:30 am", k25March_s + 0.5 * 3600},
      {"3/25/2025 12:30 PM", k25March_s + 12.5 * 3600},
  };
  for (const auto& [text, seconds] : texts) {
    const auto time = ReadDateTime(text);
    ASSERT_TRUE(time) << text;
    EXPECT_DOUBLE_EQ(*time, seconds) << text;
  }
}

TEST(ReadDateTime, KeepsTheClockOfTheLogger) {
  for (const char* text : {"2025-03-12T10:30Z", "2025-03-12T10:30:00+01:00",
                           "2025-03-12 10:30 -0700", "2025-03-12T10:30+02"}) {
    const auto time = ReadDateTime(text);
    ASSERT_TRUE(time) << text;
    EXPECT_EQ(*time, k12March_s + kHalfPastTen_s) << text;
  }
}

TEST(ReadDateTime, RefusesDayAndMonthThatCouldBeExchanged) {
  for (const char* text : {"03/04/2025", "12/12/2025 10:30", "1/2/25", "13/14/2025"}) {
    EXPECT_FALSE(ReadDateTime(text)) << text;
  }
}

TEST(ReadDateTime, RefusesDatesThatNoCalendarHas) {
  for (const char* text :
       {"2025-02-29", "1900-02-29", "2025-02-30", "2025-04-31", "2025-00-10", "2025-13-10",
        "2025-01-00", "2025-01-32", "31.4.2025", "0001-01-01", "0099-01-01", "3000-01-01",
        "2025-2147483647-01", "2025-01-2147483647", "2025-99999999999-01"}) {
    EXPECT_FALSE(ReadDateTime(text)) << text;
  }
}

TEST(ReadDateTime, RefusesTimesThatNoClockHas) {
  for (const char* time : {"24:00", "10:60", "10:30:61", "13:30 PM", "0:30 AM", "2147483647:00",
                           "10:2147483647", "10", "10:", ":30", "10:30 XM", "10:30-", "10:30+1:"}) {
    EXPECT_FALSE(ReadDateTime(std::string("2025-03-12 ") + time)) << time;
  }
}

TEST(ReadDateTime, RefusesOtherTexts) {
  for (const char* text :
       {"", " ", "\"", "noon", "2025", "2025-03", "2025-03/12", "20250312", "2025-03-12x",
        "2025-03-12T", "2025-03-12 10:30 h", "-2025-03-12", "12 March 2025", "1741775400"}) {
    EXPECT_FALSE(ReadDateTime(text)) << text;
  }
}

TEST(ReadDateTime, KnowsLeapYears) {
  EXPECT_EQ(*ReadDateTime("2024-03-01") - *ReadDateTime("2024-02-29"), kDay_s);
  EXPECT_EQ(*ReadDateTime("2000-03-01") - *ReadDateTime("2000-02-28"), 2 * kDay_s);
  EXPECT_EQ(*ReadDateTime("2100-03-01") - *ReadDateTime("2100-02-28"), kDay_s);
  EXPECT_EQ(*ReadDateTime("2025-01-01") - *ReadDateTime("2024-01-01"), 366 * kDay_s);
}

TEST(DateText, IsReadBackForEveryDayOfACycle) {
  double seconds = *ReadDateTime("1900-01-01");
  const double end = *ReadDateTime("2300-12-31");
  int days = 0;
  for (; seconds <= end; seconds += kDay_s, ++days) {
    const auto back = ReadDateTime(DateText(seconds));
    ASSERT_TRUE(back) << DateText(seconds);
    ASSERT_EQ(*back, seconds) << DateText(seconds);
  }
  EXPECT_EQ(days, 146097 + 365);  // four centuries and the year 2300
}

TEST(DateText, IsThatOfTheDayAtAnyTimeOfIt) {
  EXPECT_EQ(DateText(k12March_s), "2025-03-12");
  EXPECT_EQ(DateText(k12March_s + kDay_s - 1), "2025-03-12");
  EXPECT_EQ(DateText(-1), "1969-12-31");
  EXPECT_EQ(DateText(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(DateTimeText, RoundsToSecondsAndIsReadBack) {
  EXPECT_EQ(DateTimeText(k12March_s + kHalfPastTen_s + 5), "2025-03-12 10:30:05");
  EXPECT_EQ(DateTimeText(k12March_s - 0.4), "2025-03-12 00:00:00");
  EXPECT_EQ(DateTimeText(-1), "1969-12-31 23:59:59");
  EXPECT_EQ(DateTimeText(std::numeric_limits<double>::quiet_NaN()), "-");
  for (double seconds = -1e9; seconds < 4e9; seconds += 7654321) {
    EXPECT_EQ(ReadDateTime(DateTimeText(seconds)), seconds);
  }
}

}  // namespace
}  // namespace lyrefit
