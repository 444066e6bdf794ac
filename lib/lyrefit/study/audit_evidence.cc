#include "lyrefit/study/audit_evidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/roots.h"

namespace lyrefit {
namespace {

constexpr int kMostChanges = 3;
constexpr double kWindow = 0.5;       // half-width of the counting window in ln(RMSE / claim)
constexpr double kMostChance = 0.01;  // largest accepted number of expected accidental matches
// Relative to the claim: readings farther away get no tolerance computed.
constexpr double kFar = 0.1;
constexpr double kNear = 0.05;  // in ln(RMSE / claim): closer readings are reported as nearest

// A plan and its smallest distance to the claim over its sets of constants.
struct TriedPlan {
  const ReadingPlan* plan = nullptr;
  double distance = 0;  // |ln(RMSE / claim)|
  bool matches = false;
};

// The claim to be explained, and the number of plans tried so far.
struct Sought {
  const AuditSubject& subject;
  ReadingEvaluator evaluator;
  double claim = 0;
  int tried = 0;
  int neighbours = 0;  // number of tried plans within the window
};

// True if two plans interpret a row in the same way.
bool IsSame(const ReadingPlan& a, const ReadingPlan& b) {
  return a.curve == b.curve && a.objective == b.objective && a.newton_step == b.newton_step &&
         a.cut_off == b.cut_off && a.constants == b.constants &&
         a.resistances_per_cell == b.resistances_per_cell &&
         a.ideality_of_module == b.ideality_of_module && a.diode == b.diode && a.unit == b.unit &&
         a.conditions.cell_temperature_K == b.conditions.cell_temperature_K &&
         a.conditions.cells_in_series == b.conditions.cells_in_series;
}

TriedPlan Try(const ReadingPlan& plan, Sought* sought) {
  TriedPlan candidate;
  candidate.plan = &plan;
  candidate.distance = kInfinity;
  for (const ConstantSet set : ReadingEvaluator::SetsOf(plan)) {
    const double rmse = sought->evaluator.Figure(plan, set);
    const double distance = std::fabs(std::log(std::max(rmse, 1e-300) / sought->claim));
    candidate.distance = std::min(candidate.distance, distance);
    if (std::fabs(rmse - sought->claim) > kFar * sought->claim) continue;
    if (std::fabs(rmse - sought->claim) <= sought->evaluator.Tolerance(plan, set))
      candidate.matches = true;
  }
  ++sought->tried;
  if (candidate.distance < kWindow) ++sought->neighbours;
  return candidate;
}

// End in degrees Celsius of the temperature range in which the claim reproduces. `direction` is 1
// for the upper end and -1 for the lower.
double EndOfRange(const ReadingPlan& plan, ConstantSet set, int direction, Sought* sought) {
  constexpr double kFirstStep_K = 1e-4;
  constexpr double kFarthest_K = 10;
  const double tolerance = sought->evaluator.Tolerance(plan, set);
  const auto reproduces = [&](double step) {
    ReadingPlan moved = plan;
    moved.conditions.cell_temperature_K += direction * step;
    return std::fabs(sought->evaluator.Figure(moved, set) - sought->claim) <= tolerance;
  };
  double inside = 0;
  double outside = kFirstStep_K;
  while (outside < kFarthest_K && reproduces(outside)) {
    inside = outside;
    outside *= 2;
  }
  return plan.conditions.cell_temperature_K + direction * LastWhere(reproduces, inside, outside) -
         kZeroCelsius_K;
}

AuditExplanation Explanation(const ReadingPlan& plan, Sought* sought) {
  AuditExplanation explanation;
  explanation.reading = sought->evaluator.Read(plan);
  explanation.readings_tried = sought->tried;
  const std::size_t open = ReadingEvaluator::SetsOf(plan).size();
  const std::size_t other = open - std::max<std::size_t>(explanation.reading.constants.size(), 1);
  explanation.chance = sought->neighbours * static_cast<double>(1 + other) * 2 *
                       explanation.reading.tolerance_A / sought->claim;
  const auto& conditions = plan.curve == sought->subject.stated.curve
                               ? sought->subject.stated.conditions
                               : sought->subject.shelf->curves[plan.curve].curve.conditions;
  if (!explanation.reading.constants.empty() &&
      plan.conditions.cell_temperature_K != conditions.cell_temperature_K) {
    const ConstantSet set = explanation.reading.shown;
    explanation.low_temperature_C = EndOfRange(plan, set, -1, sought);
    explanation.high_temperature_C = EndOfRange(plan, set, 1, sought);
  }
  return explanation;
}

// Removes Newton-step plans whose solved-current plan matches too, since they explain nothing more.
void DropSteps(std::vector<TriedPlan>* matching) {
  const auto only_further = [&](const TriedPlan& candidate) {
    if (!candidate.plan->newton_step) return false;
    return std::any_of(matching->begin(), matching->end(), [&](const TriedPlan& other) {
      ReadingPlan step = *other.plan;
      step.newton_step = true;
      return !other.plan->newton_step && IsSame(step, *candidate.plan);
    });
  };
  std::vector<TriedPlan> kept;
  std::copy_if(matching->begin(), matching->end(), std::back_inserter(kept),
               [&](const TriedPlan& candidate) { return !only_further(candidate); });
  *matching = std::move(kept);
}

// Separates significant matches of one level from possibly accidental ones.
void Sort(std::vector<TriedPlan>* matching, Sought* sought, AuditSearch* result) {
  DropSteps(matching);
  std::stable_sort(matching->begin(), matching->end(),
                   [](const TriedPlan& a, const TriedPlan& b) { return a.distance < b.distance; });
  for (const TriedPlan& candidate : *matching) {
    AuditExplanation explanation = Explanation(*candidate.plan, sought);
    if (explanation.chance <= kMostChance) {
      result->explanations.push_back(std::move(explanation));
    } else if (!result->nearest) {
      result->nearest = std::move(explanation);
    }
  }
}

}  // namespace

AuditSearch Explain(const AuditSubject& subject) {
  Sought sought{subject, ReadingEvaluator(subject), subject.row->rmse.value};
  const std::vector<ReadingPlan> plans = ReadingPlans(subject, kMostChanges);
  AuditSearch result;
  std::vector<TriedPlan> matching;
  TriedPlan nearest;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    const TriedPlan candidate = Try(plans[i], &sought);
    if (plans[i].changes == 0) continue;
    if (candidate.matches) matching.push_back(candidate);
    const bool nearer = nearest.plan == nullptr || candidate.distance < nearest.distance;
    if (plans[i].changes == 1 && nearer) nearest = candidate;
    const bool level_done = i + 1 == plans.size() || plans[i + 1].changes > plans[i].changes;
    if (!level_done || matching.empty()) continue;
    Sort(&matching, &sought, &result);
    if (!result.explanations.empty()) return result;
    matching.clear();
  }
  if (!result.nearest && nearest.plan != nullptr && nearest.distance < kNear) {
    result.nearest = Explanation(*nearest.plan, &sought);
  }
  return result;
}

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
