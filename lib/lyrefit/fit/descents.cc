#include "lyrefit/fit/descents.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/fit/variant_problem.h"
#include "lyrefit/law/law.h"

namespace lyrefit {
namespace {

constexpr int kFirst = 5, kMore = 9, kOn = 20, kToTheEnd = 100;  // steps
constexpr std::size_t kOnwards = 12, kAhead = 6;
constexpr int kOfEachVariant = 2;       // go on whatever the others do
constexpr double kClose = 1.02;      // of the lowest RMSE: what may be the best after so many steps
constexpr double kNear = 3;          // of the lowest RMSE: what may still become the best
constexpr int kEnough = 3;           // ends in the best local optimum
constexpr double kSameOptimum = 1e-6;  // relative, of the mean square

// A variant that another one holds in it comes to the same curve.
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

// All go on by so many steps; the `most` best of them are left, the best first.
void Descents::GoOn(std::vector<int>* ways, int steps, std::size_t most) {
  RefineOptions briefly;
  briefly.small = true;
  briefly.let_in = false;
  briefly.max_rounds = 1;
  briefly.max_iterations = briefly.first_iterations = steps;
  briefly.trust_radius = 1e4;
  briefly.evaluation_limit = true;
  briefly.stop = watch_->stop();
  for (const int way : *ways) {
    const DescentEnd& at = ends_[way];
    const RefineProblem own = InVariant(problem_, variants_[at.start.variant], at.end.p);
    Take(way, Refine(own, at.end.p, briefly));
    if (watch_->Next()) break;
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

// Far above what has been reached already.
bool Descents::IsHopeless(const DescentEnd& end) const {
  return end.penalised > kNear * kNear * ends_[best_].penalised;
}

void Descents::Finish(const std::vector<int>& ways) {
  RefineOptions whole;
  whole.stop = watch_->stop();
  for (const int way : ways) {
    DescentEnd& at = ends_[way];
    const DescentEnd& best = ends_[best_];
    const bool known = best.finished && best.start.variant == at.start.variant && visits() >= kEnough;
    if (watch_->stopped()) break;
    if (known || at.penalised > kClose * kClose * best.penalised) continue;
    // On its way it came to where another one ended.
    at.finished = best.finished && best.start.variant == at.start.variant && SameOptimum(at, best);
    if (at.finished) continue;
    const RefineProblem own = InVariant(problem_, variants_[at.start.variant], at.end.p);
    Take(way, Refine(own, at.end.p, whole));
    at.finished = true;
  }
}

// Where a way has come to, unless it was lower before; and whether it is the best.
void Descents::Take(int way, RefineEnd end) {
  DescentEnd& at = ends_[way];
  const double factor = VariantPenalty(problem_, variants_[at.start.variant]);
  const double penalised = end.mean_square * factor * factor;
  constexpr double kSame = 1e-12;  // relative: rounding of one evaluation or another
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
    auto local_optimum = std::find_if(descents.begin(), descents.end(),
                              [&](const Optimum& known) { return SameOptimum(end, *known.first); });
    if (local_optimum == descents.end()) local_optimum = descents.insert(local_optimum, {&end, 0, 0});
    ++local_optimum->ends;
    local_optimum->apart += end.start.beside ? 0 : 1;
  }
  OptimumCount::Independent& independent = count.independent;
  for (const Optimum& local_optimum : descents) {
    count.ends += local_optimum.ends;
    independent.ends += local_optimum.apart;
    independent.descents += local_optimum.apart > 0 ? 1 : 0;
    independent.once += local_optimum.apart == 1 ? 1 : 0;
    independent.twice += local_optimum.apart == 2 ? 1 : 0;
    if (!SameOptimum(*local_optimum.first, ends_[best_])) continue;
    count.best_visits += local_optimum.ends;
    independent.best_visits += local_optimum.apart;
  }
  count.descents = static_cast<int>(descents.size());
  constexpr int kLeast = 3;
  if (independent.ends >= kLeast) {
    count.unseen = independent.once * (independent.once - 1) / (2.0 * (independent.twice + 1));
  }
  return count;
}

}  // namespace lyrefit
