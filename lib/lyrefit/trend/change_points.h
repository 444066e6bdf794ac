#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/trend/time_model.h"

namespace lyrefit {

enum class ChangeKind {
  kStep,   // the level changes from one day to the next
  kOnset,  // the rate changes from a day on
};

template <>
struct EnumTable<ChangeKind> {
  static constexpr EnumText<ChangeKind> kRows[] = {{ChangeKind::kStep, "step"},
                                                   {ChangeKind::kOnset, "onset"}};
};

// Where a series changes. The size is a coefficient of the regression.
struct ChangePoint {
  ChangeKind kind = ChangeKind::kStep;
  double day = 0;      // the first day after a step; the day from which the rate differs
  double day_low = 0;  // 95 % range of the day, by the likelihood
  double day_high = 0;
  double p_value = 1;  // over all days and both kinds
  int column = 0;      // of the design
};

struct ChangeOptions {
  double level = 0.01;  // rate of false alarms of one series over its whole span
  int draws = 999;      // of the null distribution
  std::uint64_t seed = 0;
  int most = 5;  // changes of one series
};

// The regression of a series with its changes.
struct ChangingSeries {
  TimeFit fit;
  Eigen::MatrixXd design;
  std::vector<ChangePoint> changes;  // in the order in which they were found
};

// The column of a change that begins on a day of the series: 1 from then on, or the years since the
// middle of the day before; 0 earlier. Shape: days.
Eigen::VectorXd ChangeColumn(const TimeSeries& series, ChangeKind kind, double day);

// Adds steps and onsets to a regression as long as they lower the sum of squares more than all but
// `level` of series without a change do. These are drawn from the errors of the fit that has the
// change: n normal deviates, whitened residuals and the largest gain over all days and kinds. A
// change keeps ten days of data between itself and either end and other changes.
ChangingSeries FitChanges(const TimeSeries& series, const Eigen::MatrixXd& design,
                          const ChangeOptions& options);

}  // namespace lyrefit
