#include "lyrefit/diagnose/expectation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/dense.h"
#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// Parameters at the sweep's light, and key points.
void TakeParameters(const Readings& readings, const LawFit& fit, SweepState* state) {
  state->photocurrent_A = fit.p[kIph] * readings.points.front().irradiance;
  state->ideality = Ideality(fit);
  state->series_ohm = fit.p[kRs];
  state->shunt_S = 1 / fit.p[kRsh];
  Conditions conditions;
  conditions.cell_temperature_K = readings.reference_temperature_K;
  conditions.cells_in_series = readings.scale.cells;
  const double p[] = {state->photocurrent_A, fit.p[SaturationCurrentIndex(0)], state->ideality,
                      state->series_ohm, std::min(fit.p[kRsh], 1e15)};
  const KeyPoints key = ModelKeyPoints(MakeDevice(Model::kSingleDiode, conditions), p);
  state->isc_A = key.short_circuit_current_A;
  state->voc_V = key.open_circuit_voltage_V;
  state->fill_factor = key.fill_factor;
  state->max_power_W = key.max_power_W;
}

void TakeShape(const Readings& readings, const LawFit& fit, SweepState* state) {
  const double voc = state->voc_V / readings.scale.cells;
  const double isc = state->isc_A / readings.scale.current_A;
  const std::size_t count = readings.points.size();
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return readings.points[a].voltage < readings.points[b].voltage;
  });
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(kShapeBins), number = sum;
  for (const int k : order) {
    const Reading& r = readings.points[k];
    const double u = r.voltage / voc, off = (r.current - fit.current[k]) / isc;
    state->place.push_back(u);
    state->off.push_back(off);
    const int bin = static_cast<int>(std::floor(u * kShapeBins));
    if (bin < 0 || bin >= kShapeBins) continue;
    sum[bin] += off;
    number[bin] += 1;
  }
  state->shape.resize(kShapeBins);
  for (int k = 0; k < kShapeBins; ++k) {
    state->shape[k] = number[k] > 0 ? sum[k] / number[k] : kUnknown;
  }
}

void Describe(const Readings& readings, const LawFit& fit, SweepState* state) {
  state->place.clear();
  state->off.clear();
  TakeParameters(readings, fit, state);
  TakeShape(readings, fit, state);
}

}  // namespace

Expected<FittedSweep> FitSweep(const IvCurve& curve) {
  const auto named = [&curve](Error error) {
    error.message = curve.name + ": " + error.message;
    return tl::unexpected(std::move(error));
  };
  if (auto doubts = JudgeReadings(curve); !doubts) return named(doubts.error());
  std::vector<std::string> disorder;
  auto measurement = MakeMeasurement(InOrder(SetOfOne(curve), &disorder));
  if (!measurement) return named(measurement.error());
  FittedSweep sweep;
  sweep.weighted.readings = std::make_shared<const Readings>(std::move(measurement->readings));
  const Readings& readings = *sweep.weighted.readings;
  if (readings.traits.only_dark) return Fail(curve.name + ": the curve is dark");
  sweep.weighted.sigma.assign(readings.points.size(), 1);
  sweep.weighted.used.assign(readings.points.size(), 1);
  sweep.fit = FitBase(sweep.weighted, StartingLaw(readings, Model::kSingleDiode));
  if (!sweep.fit.usable) return Fail(curve.name + ": no diode model fits these readings");
  SweepState& state = sweep.state;
  state.name = curve.name;
  state.cells = readings.scale.cells;
  state.setup = curve.notes.setup;
  state.irradiance_W_m2 = curve.irradiance_known ? curve.conditions.irradiance_W_m2 : kUnknown;
  state.temperature_C =
      curve.temperature_known ? curve.conditions.cell_temperature_K - kZeroCelsius_K : kUnknown;
  Describe(readings, sweep.fit, &state);
  if (!(state.isc_A > 0 && state.voc_V > 0 && state.fill_factor > 0)) {
    return Fail(curve.name + ": no open-circuit voltage or maximum power can be read off it");
  }
  return sweep;
}

SweepState StateWith(const FittedSweep& sweep, const std::vector<double>& change) {
  Readings readings = *sweep.weighted.readings;
  for (std::size_t k = 0; k < change.size(); ++k) readings.points[k].current += change[k];
  WeightedData weighted = sweep.weighted;
  weighted.readings = std::make_shared<const Readings>(std::move(readings));
  const LawFit fit = FitLaw(weighted, sweep.fit.law, sweep.fit.p);
  SweepState state = sweep.state;
  if (fit.usable) Describe(*weighted.readings, fit, &state);
  return state;
}

namespace {

// Median per bin; NaN if fewer than half of the sweeps have readings in it.
Eigen::VectorXd MedianShape(const std::vector<const SweepState*>& sweeps, int without = -1) {
  Eigen::VectorXd shape(kShapeBins);
  for (int bin = 0; bin < kShapeBins; ++bin) {
    std::vector<double> values;
    for (int i = 0; i < static_cast<int>(sweeps.size()); ++i) {
      if (i != without && std::isfinite(sweeps[i]->shape[bin])) {
        values.push_back(sweeps[i]->shape[bin]);
      }
    }
    shape[bin] = 2 * values.size() >= sweeps.size() ? Median(std::move(values)) : kUnknown;
  }
  return shape;
}

Eigen::VectorXd ShapeFrom(const Eigen::VectorXd& common, const SweepState& sweep) {
  Eigen::VectorXd off = sweep.shape - common;
  for (double& value : off) value = std::isfinite(value) ? value : 0;
  return off;
}

double ShapeOff(const Eigen::VectorXd& common, const SweepState& sweep) {
  constexpr double kSmallest = 1e-6;  // lower limit, as simulated sweeps have no difference
  int bins = 0;
  for (int k = 0; k < kShapeBins; ++k) bins += std::isfinite(sweep.shape[k] - common[k]) ? 1 : 0;
  const double squares = ShapeFrom(common, sweep).squaredNorm();
  return 0.5 * std::log(squares / std::max(bins, 1) + kSmallest * kSmallest);
}

Eigen::VectorXd Quantities(const SweepState& state, const Eigen::VectorXd& common) {
  Eigen::VectorXd y(kQuantities);
  y.head(kParameterQuantities) = ParametersOf(state);
  y[kShapeOff] = ShapeOff(common, state);
  return y;
}

Eigen::VectorXd Regressors(const Expectation& e, const SweepState& state) {
  Eigen::VectorXd x(3);
  x << 1, std::log(state.isc_A) - e.centre[0], state.voc_V - e.centre[1];
  return x.head(e.regressors);
}

// Positions of the references nearest to the sweep. 1 % in Voc counts as much as 4 % in Isc.
std::vector<int> Nearest(const std::vector<const SweepState*>& references,
                         const SweepState& sweep) {
  constexpr std::size_t kMost = 40;
  constexpr double kVoltageWeight = 4;
  std::vector<double> distance;
  distance.reserve(references.size());
  for (const SweepState* r : references) {
    distance.push_back(std::hypot(std::log(r->isc_A / sweep.isc_A),
                                  kVoltageWeight * std::log(r->voc_V / sweep.voc_V)));
  }
  std::vector<int> order(references.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&distance](int a, int b) { return distance[a] < distance[b]; });
  order.resize(std::min(order.size(), kMost));
  return order;
}

struct Rows {
  Eigen::MatrixXd x, y;
};

// Regression slopes; rows with `keep` 0 are left out.
Eigen::MatrixXd Slopes(const Rows& rows, const std::vector<char>& keep) {
  Eigen::MatrixXd x = rows.x, y = rows.y;
  for (int i = 0; i < x.rows(); ++i) {
    if (keep[i] != 0) continue;
    x.row(i).setZero();
    y.row(i).setZero();
  }
  return LeastSquares(x, y);
}

// Marks sweeps that are no outliers: within a few median absolute deviations of the regression in
// every quantity. Of the shape distance only large values are outliers.
std::vector<char> KeepUsual(const Rows& rows) {
  constexpr double kFar = 4;
  constexpr int kFewest = 8, kRounds = 4;
  const int count = static_cast<int>(rows.x.rows()), columns = static_cast<int>(rows.x.cols());
  std::vector<char> keep(count, 1);
  if (count < kFewest) return keep;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd off = rows.y - Times(rows.x, Slopes(rows, keep));
    std::vector<char> usual(count, 1);
    for (int j = 0; j < kQuantities; ++j) {
      std::vector<double> sizes;
      sizes.reserve(count);
      for (int i = 0; i < count; ++i) sizes.push_back(std::fabs(off(i, j)));
      const double widen = std::sqrt(static_cast<double>(count) / (count - columns));
      const double far = kFar * kMedianToSigma * widen * Median(sizes);
      for (int i = 0; i < count; ++i) {
        const double size = j == kShapeOff ? off(i, j) : sizes[i];
        if (size > far) usual[i] = 0;
      }
    }
    if (3 * std::count(usual.begin(), usual.end(), 1) < 2 * count || usual == keep) break;
    keep = usual;
  }
  return keep;
}

int RegressorsFor(std::size_t references) { return references < 6 ? 1 : references < 10 ? 2 : 3; }

Rows RowsOf(const Expectation& e, const std::vector<const SweepState*>& near) {
  const int count = static_cast<int>(near.size());
  Rows rows{Eigen::MatrixXd(count, e.regressors), Eigen::MatrixXd(count, kQuantities)};
  for (int i = 0; i < count; ++i) {
    rows.x.row(i) = Regressors(e, *near[i]).transpose();
    rows.y.row(i) = Quantities(*near[i], MedianShape(near, i)).transpose();
  }
  return rows;
}

double Leverage(const Expectation& e, const Eigen::VectorXd& x) {
  return x.dot(SolveSymmetric(e.gram, x));
}

// Covariance of the quantities of one sweep. Each residual is scaled by its leverage, as if the
// sweep were predicted from the others.
void FindCovariance(const Rows& rows, Expectation* e) {
  e->gram = TransposedTimes(rows.x, rows.x);
  e->slopes = LeastSquares(rows.x, rows.y);
  Eigen::MatrixXd off = rows.y - Times(rows.x, e->slopes);
  for (int i = 0; i < off.rows(); ++i) {
    const double leverage = Leverage(*e, rows.x.row(i).transpose());
    off.row(i) /= std::sqrt(std::max(1 - leverage, 0.1));
  }
  e->degrees = static_cast<int>(rows.x.rows()) - e->regressors;
  e->covariance = TransposedTimes(off, off) / e->degrees;
  // Quantities that do not vary between simulated sweeps would have zero variance.
  for (int j = 0; j < kQuantities; ++j) e->covariance(j, j) += 1e-14;
}

}  // namespace

Eigen::VectorXd ParametersOf(const SweepState& state) {
  const double ohm = state.voc_V / state.isc_A;
  Eigen::VectorXd y(kParameterQuantities);
  y << std::log(state.fill_factor), state.series_ohm / ohm, state.ideality, state.shunt_S * ohm;
  return y;
}

Expectation Expect(const std::vector<const SweepState*>& references, const SweepState& sweep) {
  Expectation e;
  const std::vector<int> nearest = Nearest(references, sweep);
  std::vector<const SweepState*> near;
  near.reserve(nearest.size());
  for (const int i : nearest) near.push_back(references[i]);
  e.centre = Eigen::Vector2d(std::log(sweep.isc_A), sweep.voc_V);
  e.regressors = RegressorsFor(near.size());
  const std::vector<char> keep = KeepUsual(RowsOf(e, near));
  std::vector<const SweepState*> kept;
  for (std::size_t i = 0; i < near.size(); ++i) {
    (keep[i] != 0 ? e.used : e.outliers).push_back(nearest[i]);
    if (keep[i] != 0) kept.push_back(near[i]);
  }
  e.regressors = RegressorsFor(kept.size());
  FindCovariance(RowsOf(e, kept), &e);
  e.shape = MedianShape(kept);
  e.shape_scale = Eigen::VectorXd::Zero(kShapeBins);
  for (const SweepState* sweep_state : kept) {
    e.shape_scale += ShapeFrom(e.shape, *sweep_state).cwiseAbs2();
  }
  e.shape_scale = (e.shape_scale / static_cast<double>(kept.size())).cwiseSqrt();
  return e;
}

Difference Differ(const Expectation& e, const SweepState& sweep) {
  Difference d;
  const Eigen::VectorXd x = Regressors(e, sweep);
  d.expected = TransposedTimes(e.slopes, x);
  d.value = Quantities(sweep, e.shape) - d.expected;
  d.widening = 1 + Leverage(e, x);
  d.shape = ShapeFrom(e.shape, sweep);
  double smallest = 1;
  for (int j = 0; j < kQuantities; ++j) {
    const double squared = d.value[j] * d.value[j] / (e.covariance(j, j) * d.widening);
    double p = FisherTail(squared, 1, e.degrees);
    if (j == kShapeOff) p = d.value[j] > 0 ? p / 2 : 1;
    d.p.push_back(p);
    smallest = std::min(smallest, p);
  }
  d.p_value = kQuantities * smallest;
  Eigen::VectorXd weighed;
  if (e.degrees >= 2 * kQuantities && SolvePositive(e.covariance, d.value, &weighed)) {
    const int below = e.degrees - kQuantities + 1;
    const double squared = d.value.dot(weighed) / d.widening;
    const double together =
        FisherTail(squared * below / (e.degrees * kQuantities), kQuantities, below);
    d.p_value = 2 * std::min(d.p_value, together);
  }
  d.p_value = std::min(d.p_value, 1.0);
  return d;
}

}  // namespace lyrefit
