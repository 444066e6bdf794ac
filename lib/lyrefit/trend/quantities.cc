#include "lyrefit/trend/quantities.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/curve/date_time.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/trend/change_points.h"
#include "lyrefit/trend/day_series.h"

namespace lyrefit {
namespace {

constexpr double kLeastForConditions_days = 270;  // seasons enough to tell them from a trend
constexpr double kLeastForChanges_days = 10;  // conditions of fewer days are not told from changes
constexpr double kLeastForChange_days = 30;   // a shorter series has no change so far
constexpr double kScaleError = 0.02;          // of sizes: gains, temperature of the cells, model
constexpr double kUnmonitoredLevel = 0.002;
constexpr int kMonitored = 4;  // quantities whose onsets are claimed

// What a quantity is and how it is found from a block.
struct QuantityKind {
  const char* name;
  const char* title;
  const char* unit;
  int followed;  // position among the levels; -1: of the losses
  // Value of a level, or of the sums of a block.
  double (*value)(const TrendBlocks& blocks, double level);
  bool monitored;         // its changes to the worse are onsets
  bool changes;           // whether changes are looked for
  bool operating;         // whether operating points tell it
  bool operating_onsets;  // whether its onsets in operating points hold; else they are not claimed
};

double LightPercent(const TrendBlocks& blocks, double level) {
  return 100 * std::exp(level - blocks.reference[kTrendLight]);
}

double AsPercent(const TrendBlocks& /*blocks*/, double level) { return 100 * level; }

double AsItIs(const TrendBlocks& /*blocks*/, double level) { return level; }

// Voltage in V that the device has lost since the reference.
double LostVoltage(const TrendBlocks& blocks, double level) {
  return blocks.reference[kTrendVoltage] - level;
}

constexpr QuantityKind kQuantityKinds[] = {
    {"p_mp", "power, of what the reference lets expect", "%", -1, AsItIs, false, true, true, false},
    {"light", "light on the cells, per light of the sensor", "%", kTrendLight, LightPercent, false,
     true, true, false},
    {"resistance_series", "series resistance", "ohm", kTrendSeries, AsItIs, true, true, true, true},
    {"recombination", "voltage lost by recombination", "V", kTrendVoltage, LostVoltage, true, true,
     true, false},
    {"second_diode", "share of the second diode", "%", kTrendSecond, AsPercent, false, false, false,
     false},
    {"conductance_shunt", "shunt conductance", "S", kTrendShunt, AsItIs, true, true, false, false},
    {"mismatch", "power lost by mismatch, within substrings", "%", -1, AsItIs, true, true, false,
     false},
};

double ReferenceMean(const TrendBlocks& blocks, const BlockSeries& own) {
  std::vector<ConditionedValue> first;
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    if (blocks.IsReference(own.of[k])) first.push_back({0, {}, own.series.values[k]});
  }
  return first.empty() ? kUnknown : BlockMean(first, {});
}

TrendChange ChangeOf(const ChangePoint& point, const TimeFit& fit, double first_s) {
  TrendChange change;
  change.onset = point.kind == ChangeKind::kOnset;
  change.time_s = first_s + point.day * kDay_s;
  change.earliest_s = first_s + point.day_low * kDay_s;
  change.latest_s = first_s + point.day_high * kDay_s;
  const double size = fit.coefficients[point.column];
  const double error = std::sqrt(fit.covariance(point.column, point.column));
  change.size = RangedOf(size, std::hypot(error, kScaleError * size), fit.t_95());
  change.p_value = point.p_value;
  return change;
}

// The rate in percent of the reference a year; NaN without a meaning.
Ranged RatePercent(const TrendQuantity& quantity) {
  if (quantity.unit == "%") return quantity.rate_per_year;
  if (quantity.name == "recombination" || !(quantity.reference > 0)) return {};
  return Scaled(quantity.rate_per_year, 100 / quantity.reference);
}

Eigen::MatrixXd DesignOfLine(const TimeSeries& series) {
  Eigen::MatrixXd design(static_cast<Eigen::Index>(series.days.size()), 2);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    design(i, 0) = 1;
    design(i, 1) = series.days[static_cast<std::size_t>(i)] / kYear_days;
  }
  return design;
}

// The mean rate over the series as a sum of coefficients: the rate at the start, the part of the time
// after each onset times what it adds, and, `with_steps`, each step over the years.
Eigen::VectorXd MeanRate(const TimeSeries& series, const ChangingSeries& found, bool with_steps) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(found.design.cols());
  weights[1] = 1;
  for (const ChangePoint& change : found.changes) {
    if (change.kind == ChangeKind::kStep) {
      weights[change.column] = with_steps ? kYear_days / SpanDays(series) : 0;
      continue;
    }
    weights[change.column] = (series.days.back() - change.day) / SpanDays(series);
  }
  return weights;
}

// A quantity, and its coefficients of the conditions of the days.
struct FoundQuantity {
  TrendQuantity quantity;
  std::array<double, kBetweenDays> between{};
};

// `conditions`: whether the regression has those of the days.
FoundQuantity FindQuantity(const TrendBlocks& blocks, TrendSource source,
                           const TrendOptions& options, const QuantityKind& kind,
                           const BlockSeries& own, bool conditions) {
  FoundQuantity result;
  TrendQuantity& quantity = result.quantity;
  quantity.name = kind.name;
  quantity.title = kind.title;
  quantity.unit = kind.unit;
  const bool points = source == TrendSource::kOperatingPoints;
  quantity.monitored = kind.monitored && (!points || kind.operating_onsets);
  if (!kind.operating && points) {
    quantity.missing = "operating points hardly depend on it, sweeps tell it";
    return result;
  }
  if (own.of.size() < kLeastForSizes) {
    quantity.missing = own.of.empty() ? "no measurement tells it" : "too few days tell it";
    return result;
  }
  const double years = std::max(SpanDays(own.series) / kYear_days, 1e-9);
  bool seasonal = false;
  Eigen::MatrixXd design = DesignOf(own.series, &seasonal);
  const Eigen::Index first_condition = design.cols();
  conditions = conditions && SpanDays(own.series) >= kLeastForConditions_days;
  if (conditions) design = WithConditions(blocks.mean[kind.followed], blocks, own, design);
  ChangeOptions changes;
  changes.seed = options.seed;
  changes.level = std::min(options.false_alarms_per_year * std::max(years, 0.1) / kMonitored, 0.2);
  if (!kind.changes || SpanDays(own.series) < kLeastForChanges_days) changes.most = 0;
  if (!kind.monitored) changes.level = std::min(changes.level, kUnmonitoredLevel);
  const ChangingSeries found = FitChanges(own.series, design, changes);
  const TimeFit& fit = found.fit;
  quantity.reference = ReferenceMean(blocks, own);
  if (quantity.name == "recombination") quantity.reference = 0;  // by its definition
  const double drift = std::hypot(DriftOf(quantity.name, blocks, options),
                                  SeasonOf(quantity.name, blocks, SpanDays(own.series)) / years);
  const Eigen::VectorXd mean = MeanRate(own.series, found, !kind.monitored);
  const double rate = mean.dot(fit.coefficients);
  const double error =
      std::hypot(std::sqrt(mean.dot(fit.covariance * mean)), drift, kScaleError * rate);
  const Ranged mean_rate = RangedOf(rate, error, fit.t_95());
  if (SpanDays(own.series) >= kLeastForRate_days) quantity.rate_per_year = mean_rate;
  if (SpanDays(own.series) >= kLeastForChange_days) quantity.change = Scaled(mean_rate, years);
  quantity.rate_percent = RatePercent(quantity);
  if (seasonal) quantity.seasonal = std::hypot(fit.coefficients[2], fit.coefficients[3]);
  quantity.day_scatter = fit.noise.sigma;
  quantity.shared_scatter = fit.noise.shared_sigma;
  quantity.half_life_days = fit.noise.half_life_days;
  for (const ChangePoint& point : found.changes) {
    quantity.changes.push_back(ChangeOf(point, fit, blocks.time_s.front()));
  }
  std::sort(
      quantity.changes.begin(), quantity.changes.end(),
      [](const TrendChange& one, const TrendChange& other) { return one.time_s < other.time_s; });
  Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(own.series.values.data(), found.design.rows());
  Eigen::VectorXd fitted = found.design * fit.coefficients;
  if (conditions) {
    const Eigen::VectorXd part = found.design.middleCols(first_condition, kBetweenDays) *
                                 fit.coefficients.segment(first_condition, kBetweenDays);
    values -= part;
    fitted -= part;
    for (int f = 0; f < kBetweenDays; ++f)
      result.between[f] = fit.coefficients[first_condition + f];
  }
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    quantity.days.push_back(
        {blocks.time_s[own.of[k]], values[i], fitted[i], blocks.used[own.of[k]]});
  }
  return result;
}

// The blocks with coefficients between days added to those within days.
TrendBlocks WithBetweenDays(TrendBlocks blocks, int what,
                            const std::array<double, kBetweenDays>& between) {
  Features reference{};
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks.IsReference(b)) continue;
    for (int f = 0; f < kBetweenDays; ++f) {
      reference[f] += blocks.mean[what][b][f] / blocks.reference_blocks;
    }
  }
  for (int f = 0; f < kBetweenDays; ++f) {
    blocks.departures[what][f] += between[f];
    blocks.reference[what] -= between[f] * reference[f];
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      blocks.level[what][b] -= between[f] * blocks.mean[what][b][f];
    }
  }
  return blocks;
}

// Uneven shunts bend the knee of a curve as series resistance and recombination do. Where the shunt
// grows from a day on, the rates of these are those before it.
std::vector<TrendQuantity> WithRatesBeforeShunt(std::vector<TrendQuantity> quantities,
                                                const TrendBlocks& blocks,
                                                const TrendOptions& options) {
  const auto named = [&](const char* name) {
    return std::find_if(quantities.begin(), quantities.end(),
                        [&](const TrendQuantity& one) { return one.name == name; });
  };
  double begin_s = kInfinity;
  for (const TrendChange& change : named("conductance_shunt")->changes) {
    const bool grows =
        LostByChange(blocks, "conductance_shunt", change) >= options.least_onset_percent;
    if (grows) begin_s = std::min(begin_s, change.earliest_s);
  }
  if (!std::isfinite(begin_s)) return quantities;
  for (const char* name : {"resistance_series", "recombination"}) {
    TrendQuantity& quantity = *named(name);
    TimeSeries before;
    for (const TrendDay& day : quantity.days) {
      if (day.time_s >= begin_s) break;
      before.days.push_back((day.time_s - blocks.time_s.front()) / kDay_s);
      before.values.push_back(day.value);
      before.counts.push_back(day.rows);
    }
    quantity.rate_until_s = begin_s;
    quantity.rate_per_year = quantity.rate_percent = Ranged();
    if (before.days.size() < kLeastForSizes || SpanDays(before) < kLeastForRate_days) continue;
    const TimeFit fit = FitTime(before, DesignOfLine(before));
    const double rate = fit.coefficients[1];
    const double error = std::hypot(std::sqrt(fit.covariance(1, 1)), DriftOf(name, blocks, options),
                                    kScaleError * rate);
    quantity.rate_per_year = RangedOf(rate, error, fit.t_95());
    quantity.rate_percent = RatePercent(quantity);
  }
  return quantities;
}

}  // namespace

TrendParametersFound FindParameters(TrendBlocks blocks, TrendSource source,
                                    const TrendOptions& options) {
  constexpr int kCount = std::size(kQuantityKinds);
  std::array<FoundQuantity, kCount> found;
  ParallelFor(kCount, options.threads, [&](int i) {
    const QuantityKind& kind = kQuantityKinds[i];
    if (kind.followed < 0) return;
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      const double level = blocks.level[kind.followed][b];
      return std::isfinite(level) ? kind.value(blocks, level) : kUnknown;
    });
    found[i] = FindQuantity(blocks, source, options, kind, own, true);
  });
  std::vector<TrendQuantity> quantities;
  for (int i = 0; i < kCount; ++i) {
    const QuantityKind& kind = kQuantityKinds[i];
    quantities.push_back(std::move(found[i].quantity));
    if (kind.followed < 0 || quantities.back().days.empty()) continue;
    const double scale = kind.value(blocks, blocks.reference[kind.followed] + 0.5) -
                         kind.value(blocks, blocks.reference[kind.followed] - 0.5);
    for (double& one : found[i].between) one /= scale;
    blocks = WithBetweenDays(std::move(blocks), kind.followed, found[i].between);
  }
  quantities = WithRatesBeforeShunt(std::move(quantities), blocks, options);
  return {std::move(blocks), std::move(quantities)};
}

std::vector<TrendQuantity> WithPowers(std::vector<TrendQuantity> quantities,
                                      const TrendBlocks& blocks, TrendSource source,
                                      const TrendOptions& options) {
  const std::vector<BlockSums> sums = SumsOf(blocks);
  ParallelFor(std::size(kQuantityKinds), options.threads, [&](int i) {
    const QuantityKind& kind = kQuantityKinds[i];
    if (kind.followed >= 0) return;
    const bool power = std::string(kind.name) == "p_mp";
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      return power ? 100 - TotalPercent(sums[b])
                   : PercentOf(sums[b], kPartMismatch) -
                         100 * sums[b].substrings_W / sums[b].expected_W;
    });
    quantities[i] = FindQuantity(blocks, source, options, kind, own, false).quantity;
  });
  return quantities;
}

}  // namespace lyrefit
