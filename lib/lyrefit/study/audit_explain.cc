#include "lyrefit/study/audit_explain.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

constexpr int kMostChanges = 3;
constexpr double kWindow = 0.5;       // of ln(RMSE / claim), to either side
constexpr double kMostChance = 0.01;  // expected accidental matches
constexpr double kFar = 0.1;          // of the claim; no match beyond is worth a look
constexpr double kNear = 0.05;        // of ln(RMSE / claim): worth a word

// A plan and the set of constants that brings it nearest to the claim.
struct Candidate {
  const ReadingPlan* plan = nullptr;
  double distance = 0;  // |ln(RMSE / claim)|
  bool matches = false;
};

class Explainer {
 public:
  explicit Explainer(const AuditSubject& subject)
      : subject_(subject), evaluator_(subject), claim_(subject.row->rmse.value) {}

  AuditSearch Run() {
    const std::vector<ReadingPlan> plans = ReadingPlans(subject_, kMostChanges);
    AuditSearch result;
    std::vector<Candidate> matching;
    Candidate nearest;
    for (std::size_t i = 0; i < plans.size(); ++i) {
      const Candidate candidate = Try(plans[i]);
      if (plans[i].changes == 0) continue;
      if (candidate.matches) matching.push_back(candidate);
      const bool nearer = nearest.plan == nullptr || candidate.distance < nearest.distance;
      if (plans[i].changes == 1 && nearer) nearest = candidate;
      const bool level_done = i + 1 == plans.size() || plans[i + 1].changes > plans[i].changes;
      if (!level_done || matching.empty()) continue;
      Sort(&matching, &result);
      if (!result.explanations.empty()) return result;
      matching.clear();
    }
    if (!result.nearest && nearest.plan != nullptr && nearest.distance < kNear) {
      result.nearest = Explanation(*nearest.plan);
    }
    return result;
  }

 private:
  Candidate Try(const ReadingPlan& plan) {
    Candidate candidate;
    candidate.plan = &plan;
    candidate.distance = kInfinity;
    for (const ConstantSet set : ReadingEvaluator::SetsOf(plan)) {
      const double rmse = evaluator_.Rmse(plan, plan.objective, set);
      const double distance = std::fabs(std::log(std::max(rmse, 1e-300) / claim_));
      candidate.distance = std::min(candidate.distance, distance);
      if (std::fabs(rmse - claim_) > kFar * claim_) continue;
      if (std::fabs(rmse - claim_) <= evaluator_.Tolerance(plan, set)) candidate.matches = true;
    }
    ++tried_;
    if (candidate.distance < kWindow) ++neighbours_;
    return candidate;
  }

  // Tells the matches of one level that mean something from those that may be accidents.
  void Sort(std::vector<Candidate>* matching, AuditSearch* result) {
    std::stable_sort(
        matching->begin(), matching->end(),
        [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    for (const Candidate& candidate : *matching) {
      AuditExplanation explanation = Explanation(*candidate.plan);
      if (explanation.chance <= kMostChance) {
        result->explanations.push_back(std::move(explanation));
      } else if (!result->nearest) {
        result->nearest = std::move(explanation);
      }
    }
  }

  AuditExplanation Explanation(const ReadingPlan& plan) {
    AuditExplanation explanation;
    explanation.reading = evaluator_.Read(plan);
    explanation.readings_tried = tried_;
    const std::size_t open = ReadingEvaluator::SetsOf(plan).size();
    const std::size_t other = open - std::max<std::size_t>(explanation.reading.constants.size(), 1);
    explanation.chance =
        neighbours_ * static_cast<double>(1 + other) * 2 * explanation.reading.tolerance_A / claim_;
    const auto& conditions = plan.curve == subject_.stated.curve
                                 ? subject_.stated.conditions
                                 : subject_.shelf->curves[plan.curve].curve.conditions;
    if (!explanation.reading.constants.empty() &&
        plan.conditions.cell_temperature_K != conditions.cell_temperature_K) {
      const ConstantSet set = explanation.reading.shown;
      explanation.low_temperature_C = EndOfRange(plan, set, -1);
      explanation.high_temperature_C = EndOfRange(plan, set, 1);
    }
    return explanation;
  }

  // How far the temperature may move to one side until the claim no longer reproduces.
  double EndOfRange(const ReadingPlan& plan, ConstantSet set, int direction) {
    constexpr double kFirstStep_K = 1e-4;
    constexpr double kFarthest_K = 10;
    const double tolerance = evaluator_.Tolerance(plan, set);
    const auto reproduces = [&](double step) {
      ReadingPlan moved = plan;
      moved.conditions.cell_temperature_K += direction * step;
      return std::fabs(evaluator_.Rmse(moved, moved.objective, set) - claim_) <= tolerance;
    };
    double inside = 0;
    double outside = kFirstStep_K;
    while (outside < kFarthest_K && reproduces(outside)) {
      inside = outside;
      outside *= 2;
    }
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (inside + outside);
      (reproduces(middle) ? inside : outside) = middle;
    }
    return plan.conditions.cell_temperature_K + direction * inside - kZeroCelsius_K;
  }

  const AuditSubject& subject_;
  ReadingEvaluator evaluator_;
  double claim_;
  int tried_ = 0;
  int neighbours_ = 0;
};

}  // namespace

AuditSearch Explain(const AuditSubject& subject) { return Explainer(subject).Run(); }

}  // namespace lyrefit
