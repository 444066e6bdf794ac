#include "lyrefit/study/audit_evidence.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"

namespace lyrefit {
namespace {

constexpr double kColdest_C = -20;
constexpr double kHottest_C = 120;
constexpr double kSameCurrent = 0.02;
constexpr double kOtherCurrent = 0.1;
// Largest RMSE of a matching device, relative to the short-circuit current.
constexpr double kFollows = 0.05;

double RelativeDistance(double value, double reference) {
  return std::fabs(value - reference) / std::max(std::fabs(reference), 1e-300);
}

}  // namespace

AuditTemperatures ScanTemperatures(const AuditSubject& subject) {
  constexpr int kSteps = 1400;
  ReadingEvaluator evaluator(subject);
  const ConstantSet set = ReadingEvaluator::SetsOf(subject.stated).front();
  const double claim = subject.row->rmse.value;
  const auto rmse = [&](double celsius) {
    ReadingPlan plan = subject.stated;
    plan.conditions.cell_temperature_K = celsius + kZeroCelsius_K;
    return evaluator.Figure(plan, set);
  };
  AuditTemperatures found;
  double previous_C = kColdest_C;
  double previous_A = rmse(previous_C);
  found.best_C = previous_C;
  found.best_A = previous_A;
  for (int i = 1; i <= kSteps; ++i) {
    const double celsius = kColdest_C + (kHottest_C - kColdest_C) * i / kSteps;
    const double now_A = rmse(celsius);
    if (now_A < found.best_A) {
      found.best_A = now_A;
      found.best_C = celsius;
    }
    if ((now_A > claim) != (previous_A > claim)) {
      found.at_claim_C.push_back(
          SignChange([&](double at_C) { return rmse(at_C) - claim; }, previous_C, celsius));
    }
    previous_C = celsius;
    previous_A = now_A;
  }
  return found;
}

bool HasOtherPhotocurrent(const AuditSubject& subject) {
  const double own = subject.shelf->curves[subject.stated.curve].short_circuit_A;
  return own > 0 && RelativeDistance(subject.row->parameters[kIph].value, own) > kOtherCurrent;
}

std::optional<AuditReading> FindOtherDevice(const AuditSubject& subject) {
  const double photocurrent_A = subject.row->parameters[kIph].value;
  ReadingEvaluator evaluator(subject);
  std::optional<ReadingPlan> best;
  double best_A = kInfinity;
  const auto attempt = [&](const ReadingPlan& plan) {
    const ConstantSet set = ReadingEvaluator::SetsOf(plan).front();
    const double rmse = evaluator.Figure(plan, set);
    if (rmse >= best_A) return;
    best = plan;
    best_A = rmse;
  };
  for (std::size_t c = 0; c < subject.shelf->curves.size(); ++c) {
    const AuditCurve& curve = subject.shelf->curves[c];
    if (RelativeDistance(photocurrent_A, curve.short_circuit_A) > kSameCurrent) continue;
    ReadingPlan plan = subject.stated;
    plan.curve = static_cast<int>(c);
    for (const bool per_cell : {false, true}) {
      for (const bool of_module : {false, true}) {
        plan.resistances_per_cell = per_cell;
        plan.ideality_of_module = of_module;
        plan.conditions = curve.curve.conditions;
        attempt(plan);
        for (double celsius = kColdest_C; celsius <= kHottest_C; celsius += 1) {
          plan.conditions.cell_temperature_K = celsius + kZeroCelsius_K;
          attempt(plan);
        }
      }
    }
  }
  if (!best || best_A > kFollows * subject.shelf->curves[best->curve].short_circuit_A) {
    return std::nullopt;
  }
  return evaluator.Read(*best);
}

std::vector<LeftBound> FindLeftBounds(const Device& device,
                                      const std::vector<ParameterBounds>& bounds,
                                      const AuditReading& reading) {
  std::vector<LeftBound> left;
  for (int i = 0; i < device.size(); ++i) {
    // Unit conversion rounds: 8 uA is not exactly 8e-6 A.
    const double value = reading.parameters[i];
    const double slack = reading.half_units[i] + 1e-12 * std::fabs(value);
    if (value >= bounds[i].lower - slack && value <= bounds[i].upper + slack) continue;
    left.push_back({device.parameters[i], value, bounds[i].lower, bounds[i].upper});
  }
  return left;
}

}  // namespace lyrefit
