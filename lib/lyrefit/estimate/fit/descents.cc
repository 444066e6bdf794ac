#include "lyrefit/estimate/fit/descents.h"

#include <cmath>

#include "lyrefit/estimate/fit/variant_problem.h"
#include "lyrefit/model/law.h"

namespace lyrefit {
namespace {

MultistartRules DescentRules(int threads, const ProgressReporter& progress) {
  constexpr int kOfEachVariant = 2;  // descents of a variant that always continue
  constexpr double kClose = 1.02;    // of the lowest RMSE: ends below it are run to convergence
  constexpr double kNear = 3;        // of the lowest RMSE: descents above it are stopped
  MultistartRules rules;
  rules.stages = {{5, 12, 0, kOfEachVariant, true},
                  {9, 6, 0, kOfEachVariant, true},
                  {20, 6, 0, kOfEachVariant, false},
                  {100, 6, 0, kOfEachVariant, false}};
  rules.hopeless = kNear * kNear;
  rules.close = kClose * kClose;
  rules.visits = 3;
  rules.threads = threads;
  rules.progress = progress;
  return rules;
}

// Ends are compared across variants, since a variant that is a special case of another one can
// reach its curve.
bool SameOptimum(const DescentEnd& a, const DescentEnd& b) {
  constexpr double kSameOptimum = 1e-6;  // relative, of the mean square
  return std::fabs(a.end.mean_square - b.end.mean_square) <= kSameOptimum * b.end.mean_square;
}

// Stores the new end of a descent unless it was lower before.
void Take(const RefineProblem& problem, const Variant& variant, RefineEnd end, DescentEnd* at) {
  const double factor = VariantPenalty(problem, variant);
  const double penalised = end.mean_square * factor * factor;
  constexpr double kSame = 1e-12;  // relative: rounding of repeated evaluations
  if (!at->end.p.empty() && !(penalised <= at->value * (1 + kSame))) return;
  at->end = std::move(end);
  at->value = std::isfinite(penalised) ? penalised : HUGE_VAL;
}

DescentEnd StartOf(const PreparedFit& fit, PolishStart start) {
  RefineEnd here;
  here.p = start.p;
  LawWorkspace evaluation_limit(GiveUp::kSlow);
  here.mean_square = MeanSquare(fit.problem, start.p, &evaluation_limit);
  here.active.assign(start.p.size(), false);
  DescentEnd at;
  at.group = start.variant;
  at.start = std::move(start);
  Take(fit.problem, fit.variants[at.group], std::move(here), &at);
  return at;
}

RefineOptions Briefly(int steps) {
  RefineOptions briefly;
  briefly.small = true;
  briefly.add_diodes = false;
  briefly.max_rounds = 1;
  briefly.max_iterations = briefly.first_iterations = steps;
  briefly.trust_radius = 1e4;
  briefly.evaluation_limit = true;
  return briefly;
}

}  // namespace

void Descend(const PreparedFit& fit, std::vector<PolishStart> starts,
             const ProgressReporter& progress, Descents* descents) {
  std::vector<DescentEnd> from;
  from.reserve(starts.size());
  for (PolishStart& start : starts) from.push_back(StartOf(fit, std::move(start)));
  const auto refine = [&](const MultistartStage& stage, DescentEnd* at) {
    RefineOptions how = stage.steps > 0 ? Briefly(stage.steps) : RefineOptions();
    how.stop = progress.stop();
    const Variant& variant = fit.variants[at->group];
    const RefineProblem own = InVariant(fit.problem, variant, at->end.p);
    Take(fit.problem, variant, Refine(own, at->end.p, how), at);
  };
  RunMultistart(DescentRules(fit.options.threads, progress), std::move(from), refine, SameOptimum,
                descents);
}

int BestVisits(const Descents& descents) { return Visits(descents, SameOptimum); }

OptimumCount CountOptima(const Descents& descents) {
  const std::vector<DescentEnd>& ends = descents.ends;
  const std::vector<int> first = FirstOfOptimum(ends, SameOptimum);
  std::vector<int> independent_ends(ends.size());  // of each optimum, at its first end
  OptimumCount count;
  OptimumCount::Independent& independent = count.independent;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (first[i] < 0) continue;
    const int own = ends[i].start.beside ? 0 : 1;
    const bool best = SameOptimum(ends[first[i]], descents.Best());
    independent_ends[first[i]] += own;
    count.ends += 1;
    count.best_visits += best ? 1 : 0;
    count.local_optima += first[i] == static_cast<int>(i) ? 1 : 0;
    independent.ends += own;
    independent.best_visits += best ? own : 0;
  }
  for (const int own : independent_ends) {
    independent.local_optima += own > 0 ? 1 : 0;
    independent.once += own == 1 ? 1 : 0;
    independent.twice += own == 2 ? 1 : 0;
  }
  constexpr int kLeast = 3;
  if (independent.ends >= kLeast) {
    count.unseen = independent.once * (independent.once - 1) / (2.0 * (independent.twice + 1));
  }
  return count;
}

}  // namespace lyrefit
