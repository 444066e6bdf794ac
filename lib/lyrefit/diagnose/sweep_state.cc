#include "lyrefit/diagnose/sweep_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lyrefit/base/numbers.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/sweep_order.h"
#include "lyrefit/diagnose/choose_base.h"
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

}  // namespace lyrefit
