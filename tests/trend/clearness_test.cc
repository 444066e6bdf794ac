#include "lyrefit/trend/clearness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/curve/date_time.h"

namespace lyrefit {
namespace {

// A year at 48 degrees north on a plane that faces south, by the sun's height alone, and the
// clearness of each row. `offset_h`: of the logger's clock.
std::vector<TrendRow> YearOfLight(int days, double offset_h, std::vector<double>* clearness) {
  RandomStream random(3, 59);
  std::vector<TrendRow> rows;
  for (int day = 0; day < days; ++day) {
    const double declination = 0.409 * std::sin(2 * M_PI * (day - 80) / 365.25);
    const double of_day = random.Uniform() < 0.4 ? 1 : 0.2 + 0.7 * random.Uniform();
    for (int hour = 4; hour <= 20; ++hour) {
      const double angle = M_PI / 12 * (hour - 12);
      const double sine = std::sin(0.838) * std::sin(declination) +
                          std::cos(0.838) * std::cos(declination) * std::cos(angle);
      if (sine < 0.05) continue;
      TrendRow row;
      row.state = TrendRowState::kUsed;
      row.time_s = 20089 * kDay_s + day * kDay_s + 3600 * (hour + offset_h);
      row.irradiance_W_m2 = 1050 * sine * of_day;
      rows.push_back(row);
      clearness->push_back(of_day);
    }
  }
  return rows;
}

TEST(FindSky, FindsTheClearnessOfEachRow) {
  for (const int days : {365, 70}) {
    for (const double offset_h : {0.0, 9.0}) {  // the second clock has the day around midnight
      std::vector<double> clearness;
      std::vector<TrendRow> rows = YearOfLight(days, offset_h, &clearness);
      FindSky(&rows);
      double squares = 0, count = 0, highest = 0;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].irradiance_W_m2 < 150) continue;
        squares += std::pow(rows[i].clearness - clearness[i], 2);
        highest = std::max(highest, rows[i].height);
        ++count;
      }
      EXPECT_LT(std::sqrt(squares / count), 0.06) << days << " days, " << offset_h << " h";
      EXPECT_GT(highest, 0.99);
    }
  }
}

TEST(FindSky, ASunNearTheHorizonIsLow) {
  std::vector<double> clearness;
  std::vector<TrendRow> rows = YearOfLight(365, 0, &clearness);
  FindSky(&rows);
  for (const TrendRow& row : rows) {
    const double hour = 24 * (row.time_s / kDay_s - std::floor(row.time_s / kDay_s));
    if (std::fabs(hour - 12) < 0.5) {
      EXPECT_GT(row.height, 0.93);
    } else if (std::fabs(hour - 6) < 0.5) {
      EXPECT_LT(row.height, 0.6);
    }
  }
}

TEST(FindSky, OfTooFewRowsIsClear) {
  std::vector<double> clearness;
  std::vector<TrendRow> rows = YearOfLight(5, 0, &clearness);
  FindSky(&rows);
  for (const TrendRow& row : rows) {
    EXPECT_EQ(row.clearness, 1);
    EXPECT_EQ(row.height, 1);
  }
}

}  // namespace
}  // namespace lyrefit
