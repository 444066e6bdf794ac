#include "lyrefit/devices/two_junction_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/spread.h"

namespace lyrefit {
namespace {

constexpr double kUsualLight = 0.02;  // standard deviation of stated lights

}  // namespace

JunctionTest TestJunctions(const PreparedTwoJunctions& prepared, const FitPoint& point) {
  constexpr double kExactPart = 1e-9;  // of Isc: rounding
  constexpr int kReadingsOfNoise = 3;  // for each degree of freedom of the noise
  const TwoJunctionProblem& problem = prepared.problem;
  const std::vector<LightErrors> lights = LightErrorsOf(problem, point.local);
  double squares = 0, noise = 0;
  for (std::size_t c = 0; c < problem.curves.size(); ++c) {
    const TwoJunctionCurve& curve = problem.curves[c];
    const auto device = DeviceIn(problem, static_cast<int>(c), point.p.data(), lights[c]);
    std::vector<double> residual;
    for (std::size_t k = 0; k < curve.voltage_V.size(); ++k) {
      residual.push_back(
          TwoJunctionCurrent(problem.thermal_voltage_V, device.data(), curve.voltage_V[k]) -
          curve.current_A[k]);
      squares += residual.back() * residual.back();
    }
    const double own = NoiseFromDifferences(curve.voltage_V, residual);
    noise += static_cast<double>(residual.size()) * own * own;
  }
  const int of_misfit = prepared.readings - prepared.free_parameters;
  const int of_noise = prepared.readings / kReadingsOfNoise;
  JunctionTest test;
  const double exact = kExactPart * problem.current_scale_A;
  if (!(noise > prepared.readings * exact * exact) || of_misfit < 1) return test;
  test.noise_A = std::sqrt(noise / prepared.readings);
  const double f = squares / of_misfit / (test.noise_A * test.noise_A);
  test.rmse_over_noise = std::sqrt(f);
  test.p_value = FTestPValue(1 + f * of_misfit / of_noise, 1, of_misfit, of_noise);
  return test;
}

bool IsMissed(const JunctionTest& test) {
  constexpr double kRare = 0.01;
  return test.p_value < kRare;
}

double PValueOfExactLights(const PreparedTwoJunctions& prepared, double noise_A,
                           const RefineEnd& exact, const StopToken& stop) {
  constexpr double kLoose = 0.1;  // of a light: as good as free
  const PreparedTwoJunctions loose = WithUsualLights(prepared, kLoose, noise_A);
  const TwoJunctionModel model(loose.problem);
  if (!(noise_A > 0) || model.shape().locals() == 0) return kUnknown;
  RefineOptions how;
  how.stop = stop;
  const RefineEnd end = RefineModel(model, exact, how);
  const Spread spread = FindSpread(model, end, end.active, noise_A * noise_A);
  double shown = 0;
  for (const double error : spread.local_error) {
    if (std::isfinite(error)) shown += std::max(0.0, 1 - error * error / (kLoose * kLoose));
  }
  const int extra = std::max(static_cast<int>(std::lround(shown)), 1);
  return FTestPValue(exact.mean_square, end.mean_square, extra,
                     std::max(prepared.readings - prepared.free_parameters - extra, 1));
}

std::vector<std::string> TestWarnings(const TwoJunctionReport& report) {
  std::vector<std::string> warnings;
  if (report.exchanged) {
    warnings.push_back(
        fmt::format("the lights of {0} and {1} look exchanged: with them exchanged the RMSE falls "
                    "from {2:.3g} to "
                    "{3:.3g} A. Check which file is of which spectrum",
                    report.exchanged->first, report.exchanged->second,
                    report.rmse.refined.solved_current_A, report.exchanged->rmse_A));
  } else if (IsMissed(report.light_part > 0 ? report.test_of_rest : report.test)) {
    warnings.push_back(
        "two junctions in these lights miss the readings by more than their noise: a light, a "
        "curve "
        "or the model is wrong, and the intervals are too narrow");
  }
  return warnings;
}

PreparedTwoJunctions WithUsualLights(PreparedTwoJunctions prepared, double sd, double noise_A) {
  prepared.problem.noise_A = noise_A;
  prepared.problem.light_sd = std::isnan(sd) ? kUsualLight : sd;
  return prepared;
}

PreparedTwoJunctions WithUncertainLights(PreparedTwoJunctions prepared, double sd, double noise_A,
                                         const FitPoint& point, const StopToken& stop) {
  constexpr double kLightsOfPrior = 2;
  constexpr double kSettled = 0.01;
  constexpr int kRounds = 30;
  prepared = WithUsualLights(std::move(prepared), sd, noise_A);
  TwoJunctionProblem& problem = prepared.problem;
  FitPoint from = point;
  for (int round = 0; round < kRounds && std::isnan(sd) && !stop.Stopped(); ++round) {
    const TwoJunctionModel model(problem);
    RefineOptions how;
    how.stop = stop;
    const RefineEnd end = RefineModel(model, from, how);
    const Spread spread = FindSpread(model, end, end.active, noise_A * noise_A);
    const double before = problem.light_sd;
    double squares = kLightsOfPrior * kUsualLight * kUsualLight, shown = 0;
    for (std::size_t k = 0; k < end.local.size(); ++k) {
      const double error = std::isnan(spread.local_error[k]) ? before : spread.local_error[k];
      squares += end.local[k] * end.local[k] + error * error;
      shown += std::max(0.0, 1 - error * error / (before * before));
    }
    const double lights = static_cast<double>(end.local.size());
    problem.light_sd = std::sqrt(squares / (kLightsOfPrior + lights));
    prepared.light_degrees = kLightsOfPrior + shown;
    from = end;
    if (std::fabs(problem.light_sd / before - 1) < kSettled) break;
  }
  return prepared;
}

EstimateErrors ErrorsUnderLights(const PreparedTwoJunctions& prepared, const RefineEnd& end) {
  constexpr double kKnown = 1e-3;  // of the errors of lights: as good as exact
  const TwoJunctionModel model(prepared.problem);
  EstimateErrors errors;
  errors.degrees = std::max(prepared.readings - prepared.free_parameters, 1);
  errors.variance = end.mean_square * prepared.readings / errors.degrees;
  errors.spread = FindSpread(model, end, end.active, errors.variance);
  if (!std::isfinite(prepared.light_degrees)) return errors;
  TwoJunctionProblem known = prepared.problem;
  known.light_sd *= kKnown;
  const Spread by_noise = FindSpread(TwoJunctionModel(known), end, end.active, errors.variance);
  std::vector<double>& error = errors.spread.standard_error;
  const std::vector<double> own = error;
  const double t = StudentT95(errors.degrees);
  for (std::size_t i = 0; i < error.size(); ++i) {
    const double all = error[i] * error[i];
    const double noise = by_noise.standard_error[i] * by_noise.standard_error[i];
    const double of_lights = std::max(all - noise, 0.0);
    if (!(of_lights > 0)) continue;
    const double degrees = prepared.light_degrees * std::pow(all / of_lights, 2);
    error[i] *= std::max(StudentT95(static_cast<int>(std::min(degrees, 1e6))) / t, 1.0);
  }
  errors.stretch = StretchOf(error, own);
  return errors;
}

std::optional<ExchangedLights> FindExchangedLights(const CurveSet& set,
                                                   const TwoJunctionOptions& options,
                                                   const PreparedTwoJunctions& prepared,
                                                   double rmse_A, const Observer& observer) {
  constexpr double kFarBetter = 0.6;
  std::optional<ExchangedLights> best;
  const auto stated = [](const StatedLight& light) {
    return !std::isnan(light.top) && !std::isnan(light.bottom);
  };
  for (std::size_t a = 0; a < set.curves.size(); ++a) {
    for (std::size_t b = a + 1; b < set.curves.size(); ++b) {
      const StatedLight &one = prepared.light[a], &other = prepared.light[b];
      const bool same = one.top == other.top && one.bottom == other.bottom;
      if (same || !stated(one) || !stated(other)) continue;
      TwoJunctionOptions exchanged = options;
      exchanged.lights[set.curves[a].name] = other;
      exchanged.lights[set.curves[b].name] = one;
      const auto other_way = PrepareTwoJunctions(set, exchanged);
      if (!other_way) continue;
      const RefineEnd end = EndOfJunctions(*other_way, options, observer);
      const double rmse = end.p.empty() ? HUGE_VAL : std::sqrt(end.mean_square);
      if (!(rmse < kFarBetter * (best ? best->rmse_A : rmse_A))) continue;
      best = {set.curves[a].name, set.curves[b].name, rmse};
    }
  }
  return best;
}

}  // namespace lyrefit
