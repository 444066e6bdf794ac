#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/trend/change_points.h"
#include "lyrefit/trend/day_series.h"
#include "lyrefit/trend/quantities.h"

namespace lyrefit {
namespace {

constexpr double kRecent_days = 30;     // "now"
constexpr double kPartError = 0.1;      // of a part, in % of energy: of the model
constexpr double kLightError = 0.4;     // of light: what the seasons leave of a light sensor
constexpr double kDullError = 0.2;      // of what dull skies explain between reference and series
constexpr double kMismatchError = 0.2;  // what the shapes of sweeps leave
// Of the shunt's part: what shunts of unlike cells move to series resistance and recombination.
constexpr double kUnevenShunt = 0.15;

constexpr const char* kPartNames[] = {"light", "resistance_series", "recombination", "shunt",
                                      "mismatch"};

// Changes of the quantity that a part of the loss belongs to.
std::vector<TrendChange> ChangesOf(const std::vector<TrendQuantity>& quantities,
                                   const std::string& part) {
  for (const TrendQuantity& quantity : quantities) {
    if (quantity.name == part || (part == "shunt" && quantity.name == "conductance_shunt")) {
      return quantity.changes;
    }
  }
  return {};
}

// The design and a column for each change.
Eigen::MatrixXd WithChanges(const TrendBlocks& blocks, const TimeSeries& series,
                            const std::vector<TrendChange>& changes,
                            const Eigen::MatrixXd& design) {
  Eigen::MatrixXd wider(design.rows(), design.cols() + static_cast<Eigen::Index>(changes.size()));
  wider.leftCols(design.cols()) = design;
  for (std::size_t c = 0; c < changes.size(); ++c) {
    const ChangeKind kind = changes[c].onset ? ChangeKind::kOnset : ChangeKind::kStep;
    const double day = (changes[c].time_s - blocks.time_s.front()) / kDay_s;
    wider.col(design.cols() + static_cast<Eigen::Index>(c)) = ChangeColumn(series, kind, day);
  }
  return wider;
}

double SumOfParts(const std::vector<TrendLoss>& parts, Ranged TrendLoss::*what) {
  double sum = 0;
  for (const TrendLoss& part : parts) {
    if (std::isfinite((part.*what).value)) sum += (part.*what).value;
  }
  return sum;
}

// The same interval around another value.
Ranged Around(double value, const Ranged& ranged) {
  const double shift = value - ranged.value;
  return {value, ranged.low_95 + shift, ranged.high_95 + shift};
}

// Mean of a part over the reference blocks of which most rows are used; 0: there are none. It is the
// rest of the conditions that the law does not know.
double CleanReferenceMean(const TrendBlocks& blocks, const BlockSeries& own) {
  std::vector<int> shaded(blocks.size(), 0);
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    shaded[blocks.block[i]] += blocks.rows[i].state == TrendRowState::kStepped ? 1 : 0;
  }
  std::vector<ConditionedValue> first;
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    const std::size_t b = own.of[k];
    if (!blocks.IsReference(b) || 5 * shaded[b] > blocks.used[b]) continue;
    first.push_back({0, {}, own.series.values[k]});
  }
  return first.empty() ? 0 : BlockMean(first, {});
}

// The mean of a part over blocks with these weights. It is 0 over the reference blocks, whose errors
// count too. The errors of days count; those that neighbouring days share count where the part does
// not itself change from day to day, as light and snow do.
Ranged MeanLoss(const TrendBlocks& blocks, const BlockSeries& own,
                const std::vector<double>& weights, const std::vector<TrendChange>& changes,
                bool changes_daily, double drift_per_year, double model_error) {
  const std::size_t n = own.of.size();
  std::vector<double> share(n, 0);
  double sum = 0, mean_day = 0, first_day = 0, first_count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += weights[own.of[k]];
    first_count += blocks.IsReference(own.of[k]) ? 1 : 0;
  }
  Ranged out;
  if (!(sum > 0) || !(first_count > 0)) return out;
  double value = -CleanReferenceMean(blocks, own);
  for (std::size_t k = 0; k < n; ++k) {
    const double weight = weights[own.of[k]] / sum;
    value += weight * own.series.values[k];
    mean_day += weight * own.series.days[k];
    share[k] = weight;
    if (!blocks.IsReference(own.of[k])) continue;
    first_day += own.series.days[k] / first_count;
    share[k] -= 1 / first_count;
  }
  out.value = value;
  if (n < kLeastForSizes) return out;
  bool seasonal = false;
  const Eigen::MatrixXd design =
      WithChanges(blocks, own.series, changes, DesignOf(own.series, &seasonal));
  const TimeFit fit = FitTime(own.series, design);
  TimeSeries series = own.series;
  series.spread = changes_daily ? fit.usual_spread : fit.spread;
  NoiseModel noise = fit.noise;
  if (changes_daily) noise.half_life_days = 0;
  const double variance = ErrorVariance(noise, series, share);
  const double drift = drift_per_year * (mean_day - first_day) / kYear_days;
  const double error =
      std::hypot(std::sqrt(std::max(variance, 0.0)), std::hypot(drift, model_error));
  return RangedOf(value, error, fit.t_95());
}

}  // namespace

TrendLosses FindLosses(const std::vector<TrendQuantity>& quantities, const TrendBlocks& blocks,
                       TrendSource source, const TrendOptions& options) {
  TrendLosses found;
  const std::vector<BlockSums> sums = SumsOf(blocks);
  std::vector<double> all(blocks.size(), 0), recent(blocks.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    all[b] = sums[b].expected_W;
    if (blocks.time_s[b] > blocks.time_s.back() - kRecent_days * kDay_s && !blocks.IsReference(b)) {
      recent[b] = sums[b].expected_W;
    }
  }
  for (int p = 0; p <= kTrendParts; ++p) {
    const bool total = p == kTrendParts;
    TrendLoss loss;
    loss.name = total ? "total" : kPartNames[p];
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      return total ? TotalPercent(sums[b]) : PercentOf(sums[b], p);
    });
    double drift = loss.name == "resistance_series" ? 0 : DriftOf(loss.name, blocks, options);
    if (loss.name == "recombination") drift *= PercentPerVolt(blocks);
    if (p == kPartShunt && source == TrendSource::kOperatingPoints) {
      found.losses.push_back({loss.name, {}, {}});
      found.days.emplace_back();
      continue;
    }
    const bool daily = p == kPartLight || p == kPartMismatch || total;
    const std::vector<TrendChange> changes = ChangesOf(quantities, loss.name);
    const bool mixed = p == kPartSeries || p == kPartRecombination || p == kPartShunt;
    double own_error = kPartError;
    if (p == kPartLight) own_error = kLightError;
    if (p == kPartMismatch) own_error = kMismatchError;
    if (total) own_error = std::hypot(kLightError, kMismatchError);
    const auto error = [&](const std::vector<double>& weights) {
      if (mixed) return std::hypot(own_error, kUnevenShunt * MeanPart(sums, weights, kPartShunt));
      if (p == kPartMismatch) return own_error;
      return std::hypot(own_error, kDullError * DullSkyPercent(blocks, weights));
    };
    loss.energy_percent = MeanLoss(blocks, own, all, changes, daily, drift, error(all));
    loss.now_percent = MeanLoss(blocks, own, recent, changes, daily, drift, error(recent));
    if (total) {
      // Each part is against its own clean reference: the total is their sum.
      for (const auto what : {&TrendLoss::energy_percent, &TrendLoss::now_percent}) {
        loss.*what = Around(SumOfParts(found.losses, what), loss.*what);
      }
    }
    found.losses.push_back(std::move(loss));
    if (total) continue;
    std::vector<TrendDay> days;
    for (std::size_t k = 0; k < own.of.size(); ++k) {
      days.push_back(
          {blocks.time_s[own.of[k]], own.series.values[k], kUnknown, blocks.used[own.of[k]]});
    }
    found.days.push_back(std::move(days));
  }
  return found;
}

}  // namespace lyrefit
