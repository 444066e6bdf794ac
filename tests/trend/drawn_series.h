#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "lyrefit/base/random.h"
#include "lyrefit/trend/time_model.h"

namespace lyrefit {

// About `count` days with single days and whole weeks missing.
inline std::vector<double> DaysWithGaps(int count) {
  std::vector<double> days;
  for (int day = 0; day < count; ++day) {
    const bool gap = day % 11 == 3 || (day % 70 >= 50 && day % 70 < 58);
    if (!gap) days.push_back(day + 0.5);
  }
  return days;
}

// A series of nothing but errors.
inline TimeSeries DrawErrors(const NoiseModel& noise, std::vector<double> days,
                             std::uint64_t seed) {
  RandomStream random(seed, 36);
  TimeSeries series;
  double shared = noise.shared_sigma * random.Normal();
  for (std::size_t i = 0; i < days.size(); ++i) {
    if (i > 0 && noise.half_life_days > 0) {
      const double fade = std::exp2((days[i - 1] - days[i]) / noise.half_life_days);
      shared = fade * shared + std::sqrt(1 - fade * fade) * noise.shared_sigma * random.Normal();
    }
    series.values.push_back(shared + noise.sigma * random.Normal());
  }
  series.counts.assign(days.size(), 8);  // equal: the spread of all days is 1
  series.days = std::move(days);
  return series;
}

// Columns: 1 and years.
inline Eigen::MatrixXd LineDesign(const TimeSeries& series) {
  Eigen::MatrixXd design(static_cast<Eigen::Index>(series.days.size()), 2);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    design(i, 0) = 1;
    design(i, 1) = series.days[static_cast<std::size_t>(i)] / 365.25;
  }
  return design;
}

}  // namespace lyrefit
