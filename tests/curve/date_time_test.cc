#include "lyrefit/curve/date_time.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "cases.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/technology.h"

namespace lyrefit {
namespace {

constexpr double k12March_s = 20159 * kDay_s;  // 2025-03-12
constexpr double kHalfPastTen_s = 10.5 * 3600;

TEST(ReadDateTime, ReadsAllFormsAndRefusesTheRest) {
  CheckCases(
      "curve_words",
      {{"date",
        [](const std::string& text) {
          const auto time = ReadDateTime(text);
          return time ? fmt::format("{} and {:.10g} s", DateText(*time), std::fmod(*time, kDay_s))
                      : "none";
        }},
       {"technology", [](const std::string& text) {
          const Technology* const found = FindTechnology(text);
          return fmt::format("{}, {}, junctions {}", found ? found->name : "none",
                             IsThinFilm(text) ? "thin film" : "silicon", JunctionsPerCell(text));
        }}});
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
