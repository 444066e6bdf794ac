#include "lyrefit/fit/descents.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/fit/variant_problem.h"
#include "lyrefit/law/law.h"

namespace lyrefit {
namespace {

constexpr int kFirst = 5, kMore = 9, kOn = 20, kToTheEnd = 100;  // steps
constexpr std::size_t kOnwards = 12, kAhead = 6;
constexpr int kOfEachVariant = 2;      // descents of a variant that always continue
constexpr double kClose = 1.02;        // of the lowest RMSE: ends below it are run to convergence
constexpr double kNear = 3;            // of the lowest RMSE: descents above it are stopped
constexpr int kEnough = 3;             // ends in the best local optimum
constexpr double kSameOptimum = 1e-6;  // relative, of the mean square

// Ends are compared across variants, since a variant that is a special case of another one can
// reach its curve.
bool SameOptimum(const DescentEnd& a, const DescentEnd& b) {
  return std::fabs(a.end.mean_square - b.end.mean_square) <= kSameOptimum * b.end.mean_square;
}

}  // namespace

void Descents::Descend(std::vector<PolishStart> starts) {
  std::vector<int> ways;
  for (PolishStart& start : starts) {
    RefineEnd here;
    here.p = start.p;
    LawWorkspace evaluation_limit(GiveUp::kSlow);
    here.mean_square = MeanSquare(problem_, start.p, &evaluation_limit);
    here.held.assign(start.p.size(), false);
    ways.push_back(static_cast<int>(ends_.size()));
    ends_.emplace_back();
    ends_.back().start = std::move(start);
    Take(ways.back(), std::move(here));
  }
  GoOn(&ways, kFirst, kOnwards);
  GoOn(&ways, kMore, kAhead);
  GoOn(&ways, kOn, kAhead);
  ways.erase(
      std::remove_if(ways.begin(), ways.end(), [this](int way) { return IsHopeless(ends_[way]); }),
      ways.end());
  GoOn(&ways, kToTheEnd, kAhead);
  Finish(ways);
}

// Continues all descents by `steps` steps, then keeps the `most` best, best first. The first
// kOfEachVariant of each variant are always kept.
void Descents::GoOn(std::vector<int>* ways, int steps, std::size_t most) {
  RefineOptions briefly;
  briefly.small = true;
  briefly.let_in = false;
  briefly.max_rounds = 1;
  briefly.max_iterations = briefly.first_iterations = steps;
  briefly.trust_radius = 1e4;
  briefly.evaluation_limit = true;
  briefly.stop = progress_.stop();
  for (const int way : *ways) {
    const DescentEnd& at = ends_[way];
    const RefineProblem own = InVariant(problem_, variants_[at.start.variant], at.end.p);
    Take(way, Refine(own, at.end.p, briefly));
    if (progress_.Step()) break;
  }
  std::stable_sort(ways->begin(), ways->end(),
                   [this](int a, int b) { return ends_[a].penalised < ends_[b].penalised; });
  std::vector<int> left, of_variant(variants_.size(), 0);
  for (const int way : *ways) {
    const DescentEnd& at = ends_[way];
    const bool among_first = ++of_variant[at.start.variant] <= kOfEachVariant;
    if (among_first || (left.size() < most && !IsHopeless(at))) left.push_back(way);
  }
  *ways = std::move(left);
}

// Whether an end is too far above the best one to become the best.
bool Descents::IsHopeless(const DescentEnd& end) const {
  return end.penalised > kNear * kNear * ends_[best_].penalised;
}

void Descents::Finish(const std::vector<int>& ways) {
  RefineOptions whole;
  whole.stop = progress_.stop();
  for (const int way : ways) {
    DescentEnd& at = ends_[way];
    const DescentEnd& best = ends_[best_];
    const bool known =
        best.finished && best.start.variant == at.start.variant && visits() >= kEnough;
    if (progress_.stop().requested()) break;
    if (known || at.penalised > kClose * kClose * best.penalised) continue;
    // This descent has already reached the optimum of a finished one.
    at.finished = best.finished && best.start.variant == at.start.variant && SameOptimum(at, best);
    if (at.finished) continue;
    const RefineProblem own = InVariant(problem_, variants_[at.start.variant], at.end.p);
    Take(way, Refine(own, at.end.p, whole));
    at.finished = true;
  }
}

// Stores the new end of a descent unless it was lower before, and updates the best one.
void Descents::Take(int way, RefineEnd end) {
  DescentEnd& at = ends_[way];
  const double factor = VariantPenalty(problem_, variants_[at.start.variant]);
  const double penalised = end.mean_square * factor * factor;
  constexpr double kSame = 1e-12;  // relative: rounding of repeated evaluations
  if (!at.end.p.empty() && !(penalised <= at.penalised * (1 + kSame))) return;
  at.end = std::move(end);
  at.penalised = std::isfinite(penalised) ? penalised : HUGE_VAL;
  if (best_ < 0 || at.penalised < ends_[best_].penalised) best_ = way;
}

int Descents::visits() const {
  return static_cast<int>(std::count_if(ends_.begin(), ends_.end(), [this](const DescentEnd& end) {
    return end.finished && SameOptimum(end, ends_[best_]);
  }));
}

OptimumCount Descents::Count() const {
  struct Optimum {
    const DescentEnd* first;
    int ends, apart;
  };
  std::vector<Optimum> descents;
  OptimumCount count;
  for (const DescentEnd& end : ends_) {
    if (!end.finished) continue;
    auto local_optimum = std::find_if(descents.begin(), descents.end(), [&](const Optimum& known) {
      return SameOptimum(end, *known.first);
    });
    if (local_optimum == descents.end())
      local_optimum = descents.insert(local_optimum, {&end, 0, 0});
    ++local_optimum->ends;
    local_optimum->apart += end.start.beside ? 0 : 1;
  }
  OptimumCount::Independent& independent = count.independent;
  for (const Optimum& local_optimum : descents) {
    count.ends += local_optimum.ends;
    independent.ends += local_optimum.apart;
    independent.local_optima += local_optimum.apart > 0 ? 1 : 0;
    independent.once += local_optimum.apart == 1 ? 1 : 0;
    independent.twice += local_optimum.apart == 2 ? 1 : 0;
    if (!SameOptimum(*local_optimum.first, ends_[best_])) continue;
    count.best_visits += local_optimum.ends;
    independent.best_visits += local_optimum.apart;
  }
  count.local_optima = static_cast<int>(descents.size());
  constexpr int kLeast = 3;
  if (independent.ends >= kLeast) {
    count.unseen = independent.once * (independent.once - 1) / (2.0 * (independent.twice + 1));
  }
  return count;
}

}  // namespace lyrefit
