#include "lyrefit/trend/quantities.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/model/translation.h"
#include "lyrefit/read/date_time.h"
#include "lyrefit/trend/change_points.h"

namespace lyrefit {
namespace {

constexpr double kYear_days = 365.25;
constexpr double kTwo_pi = 6.283185307179586;
constexpr std::size_t kLeastForSizes = 8;         // days from which a regression has errors
constexpr double kRecent_days = 30;               // "now"
constexpr double kLeastForConditions_days = 270;  // seasons enough to tell them from a trend
constexpr double kLeastForChanges_days = 10;  // conditions of fewer days are not told from changes
constexpr double kLeastForRate_days = 30;     // a shorter series has no rate a year
constexpr double kScaleError = 0.02;          // of sizes: gains, temperature of the cells, model
constexpr double kLeastForShortRate_days = 120;  // of a part of the series
constexpr double kLawError = 0.005;     // of a resistance a year: what seasons leave of the law
constexpr double kPartError = 0.1;      // of a part, in % of energy: of the model
constexpr double kLightError = 0.4;     // of light: what the seasons leave of a light sensor
constexpr double kMismatchError = 0.2;  // what the shapes of sweeps leave
// Of the shunt's part: what shunts of unlike cells move to series resistance and recombination.
constexpr double kUnevenShunt = 0.15;
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
  bool monitored;  // its changes to the worse are onsets
  bool changes;    // whether changes are looked for
  bool operating;  // whether operating points tell it
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
    {"p_mp", "power, of what the reference lets expect", "%", -1, AsItIs, false, true, true},
    {"light", "light on the cells, per light of the sensor", "%", kTrendLight, LightPercent, false,
     true, true},
    {"resistance_series", "series resistance", "ohm", kTrendSeries, AsItIs, true, true, true},
    {"recombination", "voltage lost by recombination", "V", kTrendVoltage, LostVoltage, true, true,
     true},
    {"second_diode", "share of the second diode", "%", kTrendSecond, AsPercent, false, false,
     false},
    {"conductance_shunt", "shunt conductance", "S", kTrendShunt, AsItIs, true, true, false},
    {"mismatch", "power lost by mismatch within substrings", "%", -1, AsItIs, true, true, false},
};

constexpr const char* kPartNames[] = {"light", "resistance_series", "recombination", "shunt",
                                      "mismatch"};

// Sums of a block.
struct BlockSums {
  double expected_W = 0;
  double substrings_W = 0;
  std::array<double, kTrendParts> parts_W{};
};

std::vector<BlockSums> SumsOf(const TrendBlocks& blocks) {
  std::vector<BlockSums> sums(blocks.size());
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    BlockSums& sum = sums[blocks.block[i]];
    sum.expected_W += blocks.rows[i].expected_W;
    sum.substrings_W += blocks.rows[i].substrings_W;
    for (int p = 0; p < kTrendParts; ++p) sum.parts_W[p] += blocks.rows[i].parts_W[p];
  }
  return sums;
}

double PercentOf(const BlockSums& sum, int part) {
  return 100 * sum.parts_W[part] / sum.expected_W;
}

// Mean of a part over blocks with these weights, in percent.
double MeanPart(const std::vector<BlockSums>& sums, const std::vector<double>& weights, int part) {
  double value = 0, sum = 0;
  for (std::size_t b = 0; b < sums.size(); ++b) {
    if (!(weights[b] > 0)) continue;
    value += weights[b] * PercentOf(sums[b], part);
    sum += weights[b];
  }
  return sum > 0 ? value / sum : 0;
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

// Features of the conditions that a regression of days has: temperature and light.
constexpr int kBetweenDays = 2;

double SpanDays(const TimeSeries& series) { return series.days.back() - series.days.front(); }

template <class Value>
BlockSeries SeriesOf(const TrendBlocks& blocks, const Value& value) {
  BlockSeries out;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const double one = value(b);
    if (!std::isfinite(one)) continue;
    out.of.push_back(b);
    out.series.days.push_back((blocks.time_s[b] - blocks.time_s.front()) / kDay_s);
    out.series.values.push_back(one);
    out.series.counts.push_back(blocks.used[b]);
  }
  return out;
}

// Columns: 1, years, and a year's sine and cosine where the series has two years.
Eigen::MatrixXd DesignOf(const TimeSeries& series, bool* seasonal) {
  *seasonal = SpanDays(series) >= 2 * kYear_days - 20;
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

// The mean features of each block less those of the reference.
Eigen::MatrixXd WithConditions(const TrendBlocks& blocks, const BlockSeries& own,
                               const Eigen::MatrixXd& design) {
  Eigen::RowVectorXd reference = Eigen::RowVectorXd::Zero(kBetweenDays);
  Eigen::MatrixXd wider(design.rows(), design.cols() + kBetweenDays);
  double count = 0;
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    const Features& mean = blocks.mean[own.of[k]];
    const auto i = static_cast<Eigen::Index>(k);
    for (int f = 0; f < kBetweenDays; ++f) wider(i, design.cols() + f) = mean[f];
    if (!blocks.IsReference(own.of[k])) continue;
    reference += wider.row(i).rightCols(kBetweenDays);
    ++count;
  }
  wider.leftCols(design.cols()) = design;
  if (count > 0) wider.rightCols(kBetweenDays).rowwise() -= reference / count;
  return wider;
}

Ranged RangedOf(double value, double error, double factor) {
  return {value, value - factor * error, value + factor * error};
}

Ranged Scaled(const Ranged& one, double by) {
  Ranged out = {one.value * by, one.low_95 * by, one.high_95 * by};
  if (by < 0) std::swap(out.low_95, out.high_95);
  return out;
}

// Error of the voltage in V per kelvin of error of the temperature sensor.
double VoltsPerKelvin(const TrendDevice& device) {
  constexpr double kUsual_C = 45;
  return std::fabs(device.OpenCircuit(device.photocurrent_A, kUsual_C + 0.5) -
                   device.OpenCircuit(device.photocurrent_A, kUsual_C - 0.5));
}

// Median light of the reference days as it is, without what would carry it to 1000 W/m2.
double PlainLight(const TrendBlocks& blocks) {
  std::vector<double> lights;
  for (std::size_t i = 0; i < blocks.rows.size(); ++i) {
    const TrendRow& row = blocks.rows[i];
    if (row.state == TrendRowState::kUsed && blocks.IsReference(blocks.block[i])) {
      lights.push_back(row.parameters[kTrendLight]);
    }
  }
  return Median(lights);
}

// Power in W of the device of the reference at 1000 W/m2 and 25 C with a voltage less.
double PowerAt(const TrendBlocks& blocks, double lost_V) {
  std::array<double, kTrendParameters> parameters{};
  std::copy_n(blocks.reference.begin(), parameters.size(), parameters.begin());
  parameters[kTrendLight] = PlainLight(blocks);
  parameters[kTrendVoltage] -= lost_V;
  const TrendState state =
      StateOf(*blocks.device, parameters, blocks.device->photocurrent_A, kReferenceTemperature_C);
  return MaximumPowerPoint(*blocks.device, state, kReferenceTemperature_C).power_W();
}

// Change of power in % by a lost volt.
double PercentPerVolt(const TrendBlocks& blocks) {
  constexpr double kStep_V = 0.01;
  const double before = PowerAt(blocks, 0);
  const double after = PowerAt(blocks, kStep_V);
  return 100 * (1 - after / before) / kStep_V;
}

// Standard deviation of what drifting instruments add in a year, in the quantity's unit.
double DriftOf(const std::string& name, const TrendBlocks& blocks, const TrendOptions& options) {
  const double light = options.irradiance_drift_percent;
  const double volts = VoltsPerKelvin(*blocks.device) * options.temperature_drift_K;
  if (name == "light") return light;
  if (name == "p_mp" || name == "total") {
    return std::hypot(light, PercentPerVolt(blocks) * volts);
  }
  if (name == "resistance_series") return kLawError * blocks.reference[kTrendSeries];
  return name == "recombination" ? volts : 0;
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
  const double size = fit.coefficients[point.column];
  const double error = std::sqrt(fit.covariance(point.column, point.column));
  change.size = RangedOf(size, std::hypot(error, kScaleError * size), fit.t_95());
  change.p_value = point.p_value;
  return change;
}

// The rate in percent of the reference a year.
void SetPercent(TrendQuantity* quantity) {
  if (quantity->unit == "%") {
    quantity->rate_percent = quantity->rate_per_year;
  } else if (quantity->name != "recombination" && quantity->reference > 0) {
    quantity->rate_percent = Scaled(quantity->rate_per_year, 100 / quantity->reference);
  }
}

Eigen::MatrixXd DesignOfLine(const TimeSeries& series) {
  Eigen::MatrixXd design(static_cast<Eigen::Index>(series.days.size()), 2);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    design(i, 0) = 1;
    design(i, 1) = series.days[static_cast<std::size_t>(i)] / kYear_days;
  }
  return design;
}

// The mean rate over the series, without steps, as a sum of coefficients: the rate at the start, and
// the part of the time after each onset times what it adds.
Eigen::VectorXd MeanRate(const TimeSeries& series, const ChangingSeries& found) {
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(found.design.cols());
  weights[1] = 1;
  for (const ChangePoint& change : found.changes) {
    if (change.kind != ChangeKind::kOnset) continue;
    weights[change.column] = (series.days.back() - change.day) / SpanDays(series);
  }
  return weights;
}

// Fills a quantity. `conditions`: whether the regression has those of the days. Returns their
// coefficients.
std::array<double, kBetweenDays> FillQuantity(const TrendBlocks& blocks, const BlockSeries& own,
                                              const TrendOptions& options, const QuantityKind& kind,
                                              bool conditions, TrendQuantity* quantity) {
  std::array<double, kBetweenDays> between{};
  if (own.of.size() < kLeastForSizes) {
    quantity->missing = own.of.empty() ? "no measurement tells it" : "too few days tell it";
    return between;
  }
  const double years = std::max(SpanDays(own.series) / kYear_days, 1e-9);
  bool seasonal = false;
  Eigen::MatrixXd design = DesignOf(own.series, &seasonal);
  const Eigen::Index first_condition = design.cols();
  conditions = conditions && SpanDays(own.series) >= kLeastForConditions_days;
  if (conditions) design = WithConditions(blocks, own, design);
  ChangeOptions changes;
  changes.seed = options.seed;
  changes.level = std::min(options.false_alarms_per_year * std::max(years, 0.1) / kMonitored, 0.2);
  if (!kind.changes || SpanDays(own.series) < kLeastForChanges_days) changes.most = 0;
  if (!kind.monitored) changes.level = std::min(changes.level, kUnmonitoredLevel);
  const ChangingSeries found = FitChanges(own.series, design, changes);
  const TimeFit& fit = found.fit;
  quantity->reference = ReferenceMean(blocks, own);
  if (quantity->name == "recombination") quantity->reference = 0;  // by its definition
  const double drift = DriftOf(quantity->name, blocks, options);
  const Eigen::VectorXd mean = MeanRate(own.series, found);
  const double rate = mean.dot(fit.coefficients);
  const double error =
      std::hypot(std::sqrt(mean.dot(fit.covariance * mean)), drift, kScaleError * rate);
  if (SpanDays(own.series) >= kLeastForRate_days) {
    quantity->rate_per_year = RangedOf(rate, error, fit.t_95());
  }
  SetPercent(quantity);
  if (seasonal) quantity->seasonal = std::hypot(fit.coefficients[2], fit.coefficients[3]);
  quantity->day_scatter = fit.noise.sigma;
  quantity->shared_scatter = fit.noise.shared_sigma;
  quantity->half_life_days = fit.noise.half_life_days;
  for (const ChangePoint& point : found.changes) {
    quantity->changes.push_back(ChangeOf(point, fit, blocks.time_s.front()));
  }
  std::sort(
      quantity->changes.begin(), quantity->changes.end(),
      [](const TrendChange& one, const TrendChange& other) { return one.time_s < other.time_s; });
  Eigen::VectorXd values =
      Eigen::Map<const Eigen::VectorXd>(own.series.values.data(), found.design.rows());
  Eigen::VectorXd fitted = found.design * fit.coefficients;
  if (conditions) {
    const Eigen::VectorXd part = found.design.middleCols(first_condition, kBetweenDays) *
                                 fit.coefficients.segment(first_condition, kBetweenDays);
    values -= part;
    fitted -= part;
    for (int f = 0; f < kBetweenDays; ++f) between[f] = fit.coefficients[first_condition + f];
  }
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    quantity->days.push_back(
        {blocks.time_s[own.of[k]], values[i], fitted[i], blocks.used[own.of[k]]});
  }
  return between;
}

// Adds coefficients between days to those within days.
void Condition(int what, const std::array<double, kBetweenDays>& between, TrendBlocks* blocks) {
  Features reference{};
  for (std::size_t b = 0; b < blocks->size(); ++b) {
    if (!blocks->IsReference(b)) continue;
    for (int f = 0; f < kBetweenDays; ++f) {
      reference[f] += blocks->mean[b][f] / blocks->reference_blocks;
    }
  }
  for (int f = 0; f < kBetweenDays; ++f) {
    blocks->departures[what][f] += between[f];
    blocks->reference[what] -= between[f] * reference[f];
    for (std::size_t b = 0; b < blocks->size(); ++b) {
      blocks->level[what][b] -= between[f] * blocks->mean[b][f];
    }
  }
}

// Changes of the quantity that a part of the loss belongs to.
std::vector<TrendChange> ChangesOf(const TrendReport& report, const std::string& part) {
  for (const TrendQuantity& quantity : report.quantities) {
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
    const double day = (changes[c].time_s - blocks.time_s.front()) / kDay_s;
    for (Eigen::Index i = 0; i < design.rows(); ++i) {
      const double after = series.days[static_cast<std::size_t>(i)] - day;
      const double value = changes[c].onset ? (after + 0.5) / kYear_days : 1;
      wider(i, design.cols() + static_cast<Eigen::Index>(c)) = after >= 0 ? value : 0;
    }
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
void ShiftTo(double value, Ranged* ranged) {
  const double shift = value - ranged->value;
  *ranged = {value, ranged->low_95 + shift, ranged->high_95 + shift};
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
// count too. The errors of days count, and those that neighbouring days share where the part does not change from
// day to day itself, as light and snow do.
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
  double variance = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (share[i] == 0) continue;
    variance += share[i] * share[i] * fit.noise.sigma * fit.noise.sigma * series.spread[i];
    if (changes_daily || fit.noise.half_life_days <= 0) continue;
    for (std::size_t j = 0; j < n; ++j) {
      if (j != i) variance += share[i] * share[j] * ErrorCovariance(fit.noise, series, i, j);
    }
    variance += share[i] * share[i] * fit.noise.shared_sigma * fit.noise.shared_sigma;
  }
  const double drift = drift_per_year * (mean_day - first_day) / kYear_days;
  const double error =
      std::hypot(std::sqrt(std::max(variance, 0.0)), std::hypot(drift, model_error));
  const Ranged ranged = RangedOf(value, error, fit.t_95());
  return ranged;
}

// Whether operating points do not tell a quantity; then says so.
bool IsUntold(const QuantityKind& kind, const TrendReport& report, TrendQuantity* quantity) {
  if (kind.operating || report.source != TrendSource::kOperatingPoints) return false;
  quantity->missing = "operating points hardly depend on it, sweeps tell it";
  return true;
}

// Uneven shunts bend the knee of a curve as series resistance and recombination do. Where the shunt
// grows from a day on, the rates of these are those before it.
void RateBeforeShunt(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report) {
  const auto named = [&](const char* name) {
    return std::find_if(report->quantities.begin(), report->quantities.end(),
                        [&](const TrendQuantity& one) { return one.name == name; });
  };
  double begin_s = kInfinity;
  for (const TrendChange& change : named("conductance_shunt")->changes) {
    if (change.size.value > 0) begin_s = std::min(begin_s, change.earliest_s);
  }
  if (!std::isfinite(begin_s)) return;
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
    if (before.days.size() < kLeastForSizes || SpanDays(before) < kLeastForShortRate_days) continue;
    const TimeFit fit = FitTime(before, DesignOfLine(before));
    const double rate = fit.coefficients[1];
    const double error = std::hypot(std::sqrt(fit.covariance(1, 1)), DriftOf(name, blocks, options),
                                    kScaleError * rate);
    quantity.rate_per_year = RangedOf(rate, error, fit.t_95());
    SetPercent(&quantity);
  }
}

TrendQuantity* NamedLike(const QuantityKind& kind, TrendQuantity* quantity) {
  quantity->name = kind.name;
  quantity->title = kind.title;
  quantity->unit = kind.unit;
  quantity->monitored = kind.monitored;
  return quantity;
}

}  // namespace

void FindParameters(const TrendOptions& options, TrendBlocks* blocks, TrendReport* report) {
  constexpr int kCount = std::size(kQuantityKinds);
  report->quantities.resize(kCount);
  std::array<std::array<double, kBetweenDays>, kCount> between{};
  ParallelFor(kCount, options.threads, [&](int i) {
    const QuantityKind& kind = kQuantityKinds[i];
    if (kind.followed < 0) return;
    TrendQuantity* const quantity = NamedLike(kind, &report->quantities[i]);
    if (IsUntold(kind, *report, quantity)) return;
    const BlockSeries own = SeriesOf(*blocks, [&](std::size_t b) {
      const double level = blocks->level[kind.followed][b];
      return std::isfinite(level) ? kind.value(*blocks, level) : kUnknown;
    });
    between[i] = FillQuantity(*blocks, own, options, kind, true, quantity);
  });
  for (int i = 0; i < kCount; ++i) {
    const QuantityKind& kind = kQuantityKinds[i];
    if (kind.followed < 0 || report->quantities[i].days.empty()) continue;
    const double scale = kind.value(*blocks, blocks->reference[kind.followed] + 0.5) -
                         kind.value(*blocks, blocks->reference[kind.followed] - 0.5);
    for (double& one : between[i]) one /= scale;
    Condition(kind.followed, between[i], blocks);
  }
  RateBeforeShunt(*blocks, options, report);
  report->reference_power_W = PowerAt(*blocks, 0) * std::exp(-blocks->reference[kModelExcess]);
}

void FindPowers(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report) {
  const std::vector<BlockSums> sums = SumsOf(blocks);
  ParallelFor(std::size(kQuantityKinds), options.threads, [&](int i) {
    const QuantityKind& kind = kQuantityKinds[i];
    if (kind.followed >= 0) return;
    TrendQuantity* const quantity = NamedLike(kind, &report->quantities[i]);
    if (IsUntold(kind, *report, quantity)) return;
    const BlockSeries own = SeriesOf(blocks, [&](std::size_t b) {
      return quantity->name == "p_mp" ? 100 - TotalPercent(sums[b])
                                      : PercentOf(sums[b], kPartMismatch) -
                                            100 * sums[b].substrings_W / sums[b].expected_W;
    });
    FillQuantity(blocks, own, options, kind, false, quantity);
  });
}

void FindLosses(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report) {
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
    if (p == kPartShunt && report->source == TrendSource::kOperatingPoints) {
      report->losses.push_back({loss.name, {}, {}});
      report->loss_days.emplace_back();
      continue;
    }
    const bool daily = p == kPartLight || p == kPartMismatch || total;
    const std::vector<TrendChange> changes = ChangesOf(*report, loss.name);
    const bool mixed = p == kPartSeries || p == kPartRecombination || p == kPartShunt;
    double own_error = kPartError;
    if (p == kPartLight) own_error = kLightError;
    if (p == kPartMismatch) own_error = kMismatchError;
    if (total) own_error = std::hypot(kLightError, kMismatchError);
    const auto error = [&](const std::vector<double>& weights) {
      return mixed ? std::hypot(own_error, kUnevenShunt * MeanPart(sums, weights, kPartShunt))
                   : own_error;
    };
    loss.energy_percent = MeanLoss(blocks, own, all, changes, daily, drift, error(all));
    loss.now_percent = MeanLoss(blocks, own, recent, changes, daily, drift, error(recent));
    if (total) {
      // Each part is against its own clean reference: the total is their sum.
      ShiftTo(SumOfParts(report->losses, &TrendLoss::energy_percent), &loss.energy_percent);
      ShiftTo(SumOfParts(report->losses, &TrendLoss::now_percent), &loss.now_percent);
    }
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
