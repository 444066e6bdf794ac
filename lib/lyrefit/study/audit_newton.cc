#include "lyrefit/study/audit_newton.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/estimate/refine/least_squares.h"

namespace lyrefit {
namespace {

constexpr int kStepParameters = 9;  // number of parameters of three diodes
constexpr double kMilli = 1e3;      // residuals are scaled to mA, so that they are near 1

using Slopes = Dual<kStepParameters>;

// The Newton step at one point, in ampere. `x` holds a device's parameters with the shunt
// conductance in place of Rsh.
template <class T>
T Step(const T* x, int diodes, double thermal_voltage_V, double voltage_V, double current_A) {
  using std::exp;
  const T junction_V = x[kRs] * current_A + voltage_V;
  T current = x[kIph] - x[kRsh] * junction_V;
  T slope = x[kRsh];
  for (int d = 0; d < diodes; ++d) {
    const T scale_V = x[IdealityIndex(d)] * thermal_voltage_V;
    const T grown = x[SaturationCurrentIndex(d)] * exp(junction_V / scale_V);
    current = current - (grown - x[SaturationCurrentIndex(d)]);
    slope = slope + grown / scale_V;
  }
  return (current - current_A) / (x[kRs] * slope + 1.0);
}

std::vector<double> WithConductance(std::vector<double> parameters) {
  parameters[kRsh] = 1 / parameters[kRsh];
  return parameters;
}

}  // namespace

double NewtonStepRmse(const Device& device, const std::vector<double>& parameters,
                      const IvCurve& curve) {
  const std::vector<double> x = WithConductance(parameters);
  double sum = 0;
  for (std::size_t i = 0; i < curve.voltage_V.size(); ++i) {
    const double step = Step(x.data(), DiodeCount(device), device.module_thermal_voltage_V,
                             curve.voltage_V[i], curve.current_A[i]);
    sum += step * step;
  }
  const double rmse = std::sqrt(sum / static_cast<double>(curve.voltage_V.size()));
  return std::isfinite(rmse) ? rmse : kInfinity;
}

double LeastNewtonStepRmse(const Device& device, const std::vector<double>& start, double n_lower,
                           double n_upper, const IvCurve& curve) {
  const int size = device.size();
  const int diodes = DiodeCount(device);
  LeastSquaresProblem problem;
  problem.residuals = static_cast<int>(curve.voltage_V.size());
  problem.lower.assign(size, 0);
  problem.upper.assign(size, kInfinity);
  for (int d = 0; d < diodes; ++d) {
    problem.lower[IdealityIndex(d)] = n_lower;
    problem.upper[IdealityIndex(d)] = n_upper;
  }
  problem.evaluate = [&](const double* p, double* residuals, double* jacobian) {
    Slopes x[kStepParameters];
    for (int k = 0; k < size; ++k) x[k] = Slopes(p[k], k);
    for (int i = 0; i < problem.residuals; ++i) {
      const Slopes step =
          Step(x, diodes, device.module_thermal_voltage_V, curve.voltage_V[i], curve.current_A[i]) *
          kMilli;
      if (!std::isfinite(step.a)) return false;
      residuals[i] = step.a;
      if (jacobian != nullptr) std::copy_n(step.v, size, jacobian + i * size);
    }
    return true;
  };
  constexpr int kSteps = 500;
  const LeastSquaresEnd end =
      SolveLeastSquares(problem, WithConductance(start), UpTo(kSteps, 1e-15));
  if (!end.usable) return kUnknown;
  return std::sqrt(end.sum_of_squares / problem.residuals) / kMilli;
}

}  // namespace lyrefit
