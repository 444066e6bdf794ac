#include "lyrefit/study/audit_lowest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dual.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/estimate/fit/fit.h"
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

namespace {

// Range of n for proved lower bounds. It is wider than the range of real diodes.
constexpr double kLowestProved = 0.5;
constexpr double kHighestProved = 4;

// Limits of proofs for the solved current. The tolerance is finer than the digits of any claim, and
// the effort stops proofs that do not converge.
constexpr double kSolvedProofTolerance = 1e-9;
constexpr std::int64_t kSolvedProofEffort = 5000;

// Leaves `lowest` unchanged if no bound can be proved for the curve.
void Prove(const IvCurve& curve, Model model, ConstantSet constants, AuditLowest* lowest) {
  CertifyOptions options;
  options.n_lower = kLowestProved;
  options.n_upper = kHighestProved;
  options.models = {model};
  options.objective = lowest->objective;
  options.constants = constants;
  if (lowest->objective == Objective::kSolvedCurrent) {
    options.tolerance = kSolvedProofTolerance;
    options.effort = kSolvedProofEffort;
  }
  const Expected<Certificate> certificate = Certify(curve, options);
  if (!certificate || certificate->models.empty()) return;
  lowest->lower_bound_A = certificate->models[0].lower_bound_A;
  lowest->reached_A = certificate->models[0].rmse_A;
  lowest->n_lower = kLowestProved;
  lowest->n_upper = kHighestProved;
}

}  // namespace

const LowestFinder::Fitted& LowestFinder::Fit(const AuditSubject& subject, const ReadingPlan& plan,
                                              ConstantSet constants) {
  const std::string key =
      fmt::format("{} {} {} {} {} {}", plan.curve, plan.conditions.cell_temperature_K,
                  plan.conditions.cells_in_series, ToText(subject.row->model),
                  ToText(plan.objective), ToText(constants));
  if (const auto known = fitted_.find(key); known != fitted_.end()) return known->second;
  IvCurve curve = subject.shelf->curves[plan.curve].curve;
  curve.conditions = plan.conditions;
  curve.as_is = true;  // no refusal by CheckReadings: the publication may count other cells
  FitOptions options;
  options.model = subject.row->model;
  options.objective = plan.objective;
  options.constants = constants;
  options.intervals = Intervals::kNone;
  options.random_baseline = false;
  const Expected<FitReport> fit = lyrefit::Fit(curve, options);
  Fitted& fitted = fitted_[key];
  fitted.rmse_A = fit ? fit->rmse.refined.Of(plan.objective) : kUnknown;
  if (fit) fitted.parameters = fit->refined;
  return fitted;
}

double LowestFinder::Optimum(const AuditSubject& subject, const ReadingPlan& plan,
                             ConstantSet constants) {
  return Fit(subject, plan, constants).rmse_A;
}

std::optional<AuditLowest> LowestFinder::Find(const AuditSubject& subject, ConstantSet constants) {
  const AuditCurve& curve = subject.shelf->curves[subject.stated.curve];
  ReadingPlan plan;
  plan.curve = subject.stated.curve;
  plan.conditions = curve.curve.conditions;
  plan.objective = subject.stated.objective;
  const Model model = subject.row->model;
  const std::string key = fmt::format("{} {} {} {}", plan.curve, ToText(model),
                                      ToText(plan.objective), ToText(constants));
  if (const auto known = lowest_.find(key); known != lowest_.end()) return known->second;
  AuditLowest lowest;
  lowest.objective = plan.objective;
  lowest.rmse_A = Optimum(subject, plan, constants);
  if (std::isnan(lowest.rmse_A)) return std::nullopt;
  lowest.n_lower = kLowestFitted;
  lowest.n_upper = kHighestFitted;
  Prove(curve.curve, model, constants, &lowest);
  ReadingPlan solved = plan;
  solved.objective = Objective::kSolvedCurrent;
  ReadingPlan other = plan.objective == Objective::kMeasuredCurrent ? solved : plan;
  if (plan.objective == Objective::kSolvedCurrent) other.objective = Objective::kMeasuredCurrent;
  lowest.other_objective_A = Optimum(subject, other, constants);
  const Fitted& root = Fit(subject, solved, constants);
  if (!root.parameters.empty()) {
    const Device device = MakeDevice(model, plan.conditions, constants);
    lowest.newton_step_A =
        LeastNewtonStepRmse(device, root.parameters, kLowestFitted, kHighestFitted, curve.curve);
  }
  return lowest_[key] = lowest;
}

double LowestFound(const AuditLowest& lowest) { return std::fmin(lowest.rmse_A, lowest.reached_A); }

bool IsBelow(const PrintedNumber& claim, double rmse_A) {
  return claim.value + 2 * claim.half_unit <= rmse_A;
}

bool IsPrintOf(const PrintedNumber& claim, double value) {
  const double above = value - claim.value;
  return above >= -claim.half_unit && above < 2 * claim.half_unit;
}

}  // namespace lyrefit
