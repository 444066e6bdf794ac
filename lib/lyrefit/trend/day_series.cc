#include "lyrefit/trend/day_series.h"

#include <algorithm>

#include "lyrefit/base/median.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

constexpr double kLawError = 0.005;  // of a resistance a year: what seasons leave of the law

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

}  // namespace

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

double SpanDays(const TimeSeries& series) { return series.days.back() - series.days.front(); }

Eigen::MatrixXd DesignOf(const TimeSeries& series, bool* seasonal) {
  *seasonal = SpanDays(series) >= 2 * kYear_days - 20;
  Eigen::MatrixXd design(static_cast<Eigen::Index>(series.days.size()), *seasonal ? 4 : 2);
  for (Eigen::Index i = 0; i < design.rows(); ++i) {
    const double years = series.days[static_cast<std::size_t>(i)] / kYear_days;
    design(i, 0) = 1;
    design(i, 1) = years;
    if (!*seasonal) continue;
    design(i, 2) = std::cos(2 * M_PI * years);
    design(i, 3) = std::sin(2 * M_PI * years);
  }
  return design;
}

Eigen::MatrixXd WithConditions(const std::vector<Features>& conditions, const TrendBlocks& blocks,
                               const BlockSeries& own, const Eigen::MatrixXd& design) {
  Eigen::RowVectorXd reference = Eigen::RowVectorXd::Zero(kBetweenDays);
  Eigen::MatrixXd wider(design.rows(), design.cols() + kBetweenDays);
  double count = 0;
  for (std::size_t k = 0; k < own.of.size(); ++k) {
    const Features& mean = conditions[own.of[k]];
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

double PowerAt(const TrendBlocks& blocks, TrendParameter what, double change) {
  std::array<double, kTrendParameters> parameters{};
  std::copy_n(blocks.reference.begin(), parameters.size(), parameters.begin());
  parameters[kTrendLight] = PlainLight(blocks);
  parameters[what] += change;
  const DeviceState state =
      StateOf(*blocks.device, parameters, blocks.device->photocurrent_A, kReferenceTemperature_C);
  return MaximumPowerPoint(*blocks.device, state, kReferenceTemperature_C).power_W();
}

double LostByChange(const TrendBlocks& blocks, const std::string& name, double change) {
  const double before = PowerAt(blocks);
  double after = before;
  if (name == "resistance_series") after = PowerAt(blocks, kTrendSeries, change);
  if (name == "recombination") after = PowerAt(blocks, kTrendVoltage, -change);
  if (name == "conductance_shunt") after = PowerAt(blocks, kTrendShunt, change);
  if (name == "mismatch") return change;
  return 100 * (1 - after / before);
}

double LostByChange(const TrendBlocks& blocks, const std::string& name, const TrendChange& change) {
  const double last_s = blocks.rows.back().time_s;
  const double years = change.onset ? (last_s - change.time_s) / (kYear_days * kDay_s) : 1;
  return LostByChange(blocks, name, change.size.value * years);
}

double PercentPerVolt(const TrendBlocks& blocks) {
  constexpr double kStep_V = 0.01;
  return LostByChange(blocks, "recombination", kStep_V) / kStep_V;
}

double SeasonOf(const std::string& name, const TrendBlocks& blocks, double days) {
  constexpr double kSeason_K = 0.3;
  if (name != "recombination" || days >= kLeastForRate_days) return 0;
  return kSeason_K * VoltsPerKelvin(*blocks.device);
}

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

}  // namespace lyrefit
