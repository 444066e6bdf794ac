#include "lyrefit/trend/quantities.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/date_time.h"
#include "lyrefit/trend/change_points.h"
#include "lyrefit/trend/loss_split.h"

namespace lyrefit {
namespace {

constexpr double kYear_days = 365.25;
constexpr double kTwo_pi = 6.283185307179586;
constexpr std::size_t kLeastForSizes = 8;   // days from which a regression has errors
constexpr double kRecent_days = 30;         // "now"
constexpr double kFewSweeps = 3;            // spread of a day of one sweep is 1 + 3
constexpr int kMonitored = 4;               // quantities whose onsets are claimed

// What a quantity is and how it is found from a block.
struct QuantityKind {
  const char* name;
  const char* title;
  const char* unit;
  int followed;  // position among the levels; -1: of the losses
  // Value of a level, or of the sums of a block.
  double (*value)(const TrendBlocks& blocks, double level);
  bool monitored;  // its changes count as false alarms where there is none
};

double LightPercent(const TrendBlocks& blocks, double level) {
  return 100 * std::exp(level - blocks.reference[kTrendLight]);
}

double AsItIs(const TrendBlocks& /*blocks*/, double level) { return level; }

// Voltage in V at 25 C that the change of the saturation current costs.
double RecombinationVolts(const TrendBlocks& blocks, double level) {
  return blocks.device->ThermalVoltage(kReferenceTemperature_C) *
         (level - blocks.reference[kTrendRecombination]);
}

constexpr QuantityKind kQuantityKinds[] = {
    {"p_mp", "power, of what the reference lets expect", "%", -1, AsItIs, false},
    {"light", "light on the cells, per light of the sensor", "%", kTrendLight, LightPercent, false},
    {"resistance_series", "series resistance", "ohm", kTrendSeries, AsItIs, true},
    {"recombination", "voltage lost by recombination", "V", kTrendRecombination,
     RecombinationVolts, true},
    {"conductance_shunt", "shunt conductance", "S", kTrendShunt, AsItIs, true},
    {"mismatch", "power lost by mismatch", "%", -1, AsItIs, true},
};

constexpr const char* kPartNames[] = {"light", "resistance_series", "recombination", "shunt",
                                      "mismatch"};

// Sums of a block.
struct BlockSums {
  double expected_W = 0;
  std::array<double, kTrendParts> parts_W{};
};

std::vector<BlockSums> SumsOf(const TrendBlocks& blocks) {
  std::vector<BlockSums> sums(blocks.size());
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    BlockSums& sum = sums[blocks.block[i]];
    sum.expected_W += blocks.rows[i].expected_W;
    for (int p = 0; p < kTrendParts; ++p) sum.parts_W[p] += blocks.rows[i].parts_W[p];
  }
  return sums;
}

double PercentOf(const BlockSums& sum, int part) {
  return 100 * sum.parts_W[part] / sum.expected_W;
}

double TotalPercent(const BlockSums& sum) {
  double total = 0;
  for (int p = 0; p < kTrendParts; ++p) total += PercentOf(sum, p);
  return total;
}

// A series of the blocks that have a value; `of`: their positions.
struct BlockSeries {
  TimeSeries series;
  std::vector<std::size_t> of;
};

template <class Value>
BlockSeries SeriesOf(const TrendBlocks& blocks, const Value& value) {
  BlockSeries out;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double one = value(b);
    if (!std::isfinite(one)) continue;
    out.of.push_back(b);
    out.series.days.push_back((blocks.time_s[b] - blocks.time_s.front()) / kDay_s);
    out.series.values.push_back(one);
    out.series.spread.push_back(1 + kFewSweeps / blocks.used[b]);
  }
  return out;
}

// Columns: 1, years, and a year's sine and cosine where the series has two years.
Eigen::MatrixXd DesignOf(const TimeSeries& series, bool* seasonal) {
  *seasonal = series.days.back() - series.days.front() >= 2 * kYear_days - 20;
  Eigen::MatrixXd design(static_cast<Eigen::Index>(series.days.size()), *seasonal ? 4 : 2);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const double years = series.days[static_cast<std::size_t>(i)] / kYear_days;
    design(i, 0) = 1;
    design(i, 1) = years;
    if (!*seasonal) continue;
    design(i, 2) = std::cos(kTwo_pi * years);
    design(i, 3) = std::sin(kTwo_pi * years);
  }
  return design;
}

Ranged RangedOf(double value, double error, double factor) {
  return {value, value - factor * error, value + factor * error};
}

Ranged Scaled(const Ranged& one, double by) {
  Ranged out = {one.value * by, one.low_95 * by, one.high_95 * by};
  if (by < 0) std::swap(out.low_95, out.high_95);
  return out;
}

// Change of the apparent ln of the saturation current at 25 C per kelvin of error of the sensor:
// the voltage is the same, the law is taken at another temperature.
double SaturationErrorPerKelvin(const TrendDevice& device) {
  constexpr double kUsual_C = 45;
  const auto apparent = [&](double temperature_C) {
    const double voc = device.ThermalVoltage(kUsual_C) *
                       (std::log(device.photocurrent_A) - device.ln_saturation_current -
                        device.SaturationShift(kUsual_C));
    return -voc / device.ThermalVoltage(temperature_C) - device.SaturationShift(temperature_C);
  };
  return std::fabs(apparent(kUsual_C + 0.5) - apparent(kUsual_C - 0.5));
}

// Change of power in % by one unit of ln of the saturation current.
double PercentPerSaturation(const TrendBlocks& blocks) {
  TrendState state = {blocks.device->photocurrent_A, blocks.reference[kTrendSeries],
                      blocks.reference[kTrendRecombination],
                      std::max(blocks.reference[kTrendShunt], 0.0)};
  const double before = PowerOf(*blocks.device, state, kReferenceTemperature_C);
  state[kTrendRecombination] += 0.1;
  return 1000 * (1 - PowerOf(*blocks.device, state, kReferenceTemperature_C) / before);
}

// Standard deviation of what drifting instruments add in a year, in the quantity's unit.
double DriftOf(const std::string& name, const TrendBlocks& blocks, const TrendOptions& options) {
  const double light = options.irradiance_drift_percent;
  const double ln_is = SaturationErrorPerKelvin(*blocks.device) * options.temperature_drift_K;
  const double power = PercentPerSaturation(blocks) * ln_is;
  if (name == "light") return light;
  if (name == "p_mp" || name == "total") return std::hypot(light, power);
  if (name != "recombination") return 0;
  return blocks.device->ThermalVoltage(kReferenceTemperature_C) * ln_is;
}

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
  change.size = RangedOf(fit.coefficients[point.column],
                         std::sqrt(fit.covariance(point.column, point.column)), fit.t_95());
  change.p_value = point.p_value;
  return change;
}

void FillQuantity(const TrendBlocks& blocks, const BlockSeries& own, const TrendOptions& options,
                  bool monitored, TrendQuantity* quantity) {
  if (own.of.size() < kLeastForSizes) {
    quantity->missing = own.of.empty() ? "no measurement tells it" : "too few days tell it";
    return;
  }
  const double years =
      std::max((own.series.days.back() - own.series.days.front()) / kYear_days, 1e-9);
  bool seasonal = false;
  const Eigen::MatrixXd design = DesignOf(own.series, &seasonal);
  ChangeOptions changes;
  changes.seed = options.seed;
  changes.level = std::min(options.false_alarms_per_year * std::max(years, 0.1) / kMonitored, 0.2);
  if (!monitored) changes.level = std::min(changes.level, 0.01);
  const ChangingSeries found = FitChanges(own.series, design, changes);
  const TimeFit& fit = found.fit;
  quantity->reference = ReferenceMean(blocks, own);
  const double drift = DriftOf(quantity->name, blocks, options);
  const double error = std::hypot(std::sqrt(fit.covariance(1, 1)), drift);
  quantity->rate_per_year = RangedOf(fit.coefficients[1], error, fit.t_95());
  const bool relative = quantity->unit != "%" && quantity->name != "recombination";
  if (relative && quantity->reference > 0) {
    quantity->rate_percent = Scaled(quantity->rate_per_year, 100 / quantity->reference);
  } else if (!relative && quantity->unit == "%") {
    quantity->rate_percent = quantity->rate_per_year;
  }
  if (seasonal) quantity->seasonal = std::hypot(fit.coefficients[2], fit.coefficients[3]);
  quantity->day_scatter = fit.noise.sigma;
  quantity->shared_scatter = fit.noise.shared_sigma;
  quantity->half_life_days = fit.noise.half_life_days;
  for (const ChangePoint& point : found.changes) {
    quantity->changes.push_back(ChangeOf(point, fit, blocks.time_s.front()));
  }
  std::sort(quantity->changes.begin(), quantity->changes.end(),
            [](const TrendChange& one, const TrendChange& other) {
              return one.time_s < other.time_s;
            });
  const Eigen::VectorXd fitted = found.design * fit.coefficients;
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    quantity->days.push_back({blocks.time_s[own.of[k]], own.series.values[k],
                              fitted[static_cast<Eigen::Index>(k)], blocks.used[own.of[k]]});
  }
}

// The mean of a part over blocks with these weights, less that over the reference blocks. The
// errors of days count, and those that neighbouring days share where the part does not change from
// day to day itself, as light and snow do.
Ranged MeanLoss(const TrendBlocks& blocks, const BlockSeries& own,
                const std::vector<double>& weights, bool changes_daily, double drift_per_year) {
  const std::size_t n = own.of.size();
  std::vector<double> share(n, 0);
  double sum = 0, mean_day = 0, first_day = 0, first_count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += weights[own.of[k]];
    first_count += blocks.IsReference(own.of[k]) ? 1 : 0;
  }
  Ranged out;
  if (!(sum > 0)) return out;
  double value = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double weight = weights[own.of[k]] / sum;
    value += weight * own.series.values[k];
    mean_day += weight * own.series.days[k];
    share[k] = weight;
    if (!blocks.IsReference(own.of[k])) continue;
    first_day += own.series.days[k] / first_count;
    share[k] -= 1 / first_count;
  }
  value -= ReferenceMean(blocks, own);
  out.value = value;
  if (n < kLeastForSizes) return out;
  bool seasonal = false;
  const Eigen::MatrixXd design = DesignOf(own.series, &seasonal);
  const TimeFit fit = FitTime(own.series, design);
  double variance = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (share[i] == 0) continue;
    variance += share[i] * share[i] * fit.noise.sigma * fit.noise.sigma * own.series.spread[i];
    if (changes_daily || fit.noise.half_life_days <= 0) continue;
    for (std::size_t j = 0; j < n; ++j) {
      if (j != i) variance += share[i] * share[j] * ErrorCovariance(fit.noise, own.series, i, j);
    }
    variance += share[i] * share[i] * fit.noise.shared_sigma * fit.noise.shared_sigma;
  }
  const double drift = drift_per_year * (mean_day - first_day) / kYear_days;
  const double error = std::hypot(std::sqrt(std::max(variance, 0.0)), drift);
  const Ranged ranged = RangedOf(value, error, fit.t_95());
  return ranged;
}

}  // namespace

void FindQuantities(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report) {
  const std::vector<BlockSums> sums = SumsOf(blocks);
  constexpr int kCount = std::size(kQuantityKinds);
  report->quantities.resize(kCount);
  ParallelFor(kCount, options.threads, [&](int i) {
    const QuantityKind& kind = kQuantityKinds[i];
    TrendQuantity& quantity = report->quantities[static_cast<std::size_t>(i)];
    quantity.name = kind.name;
    quantity.title = kind.title;
    quantity.unit = kind.unit;
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      if (kind.followed >= 0) {
        const double level = blocks.level[kind.followed][b];
        return std::isfinite(level) ? kind.value(blocks, level) : kUnknown;
      }
      return quantity.name == "p_mp" ? 100 - TotalPercent(sums[b])
                                     : PercentOf(sums[b], kPartMismatch);
    });
    FillQuantity(blocks, own, options, kind.monitored, &quantity);
  });
  const TrendState state = {
      blocks.device->photocurrent_A * std::exp(blocks.reference[kTrendLight]),
      blocks.reference[kTrendSeries], blocks.reference[kTrendRecombination],
      std::max(blocks.reference[kTrendShunt], 0.0)};
  report->reference_power_W = PowerOf(*blocks.device, state, kReferenceTemperature_C) *
                              std::exp(-blocks.reference[kModelExcess]);
}

void FindLosses(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report) {
  const std::vector<BlockSums> sums = SumsOf(blocks);
  std::vector<double> after(blocks.size(), 0), recent(blocks.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (!blocks.IsReference(b)) after[b] = sums[b].expected_W;
    if (blocks.time_s[b] > blocks.time_s.back() - kRecent_days * kDay_s &&
        !blocks.IsReference(b)) {
      recent[b] = sums[b].expected_W;
    }
  }
  const double volts = PercentPerSaturation(blocks) /
                       blocks.device->ThermalVoltage(kReferenceTemperature_C);
  for (int p = 0; p <= kTrendParts; ++p) {
    const bool total = p == kTrendParts;
    TrendLoss loss;
    loss.name = total ? "total" : kPartNames[p];
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      return total ? TotalPercent(sums[b]) : PercentOf(sums[b], p);
    });
    double drift = DriftOf(loss.name, blocks, options);
    if (loss.name == "recombination") drift *= volts;
    const bool daily = p == kTrendLight || p == kPartMismatch || total;
    loss.energy_percent = MeanLoss(blocks, own, after, daily, drift);
    loss.now_percent = MeanLoss(blocks, own, recent, daily, drift);
    report->losses.push_back(std::move(loss));
    if (total) continue;
    std::vector<TrendDay> days;
    for (std::size_t k = 0; k < own.of.size(); ++k) {
      days.push_back(
          {blocks.time_s[own.of[k]], own.series.values[k], kUnknown, blocks.used[own.of[k]]});
    }
    report->loss_days.push_back(std::move(days));
  }
}

}  // namespace lyrefit
