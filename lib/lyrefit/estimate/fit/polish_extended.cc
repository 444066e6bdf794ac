#include "lyrefit/estimate/fit/polish_extended.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr std::size_t kProbes = 4;
constexpr std::size_t kCandidates = 3;
constexpr std::size_t kShapes = 3;
constexpr int kFurther = 3;  // rounds of random points, and of probes near the best end
constexpr int kAgain = 2;    // ends in the best optimum that make further rounds unnecessary
constexpr int kSteps = 6;    // rounds of neighbours of the best end

// For each effect whether the shape of the curve gives no start for it.
std::vector<bool> Shapeless(const PreparedFit& fit) {
  std::vector<bool> shapeless;
  for (const EffectUse& use : fit.problem.device.effects->uses) {
    shapeless.push_back(use.effect->starts == nullptr);
  }
  return shapeless;
}

// Whether the residuals of the best end are like noise (Durbin and Watson 1950,
// doi:10.1093/biomet/37.3-4.409). Then no better local optimum is expected.
bool LeavesNoise(const PreparedFit& fit, const Descents& descents) {
  constexpr double kLeast = 1.2;  // 2: independent residuals; 0: all equal
  std::vector<double> residuals(fit.problem.voltage_V.size());
  Residuals(fit.problem, descents.Best().end.p.data(), residuals.data(), nullptr);
  return FindResidualStatistics(fit.problem.voltage_V, residuals).durbin_watson > kLeast;
}

void TryNeighbours(const PreparedFit& fit, const ProgressReporter& progress, Descents* descents) {
  for (int step = 0; step < kSteps && !progress.stop().requested(); ++step) {
    const int before = descents->best;
    std::vector<PolishStart> neighbours = Neighbours(fit, descents->ends[before]);
    // Variants can differ by less than the noise.
    if (fit.variants.size() > 1 || !LeavesNoise(fit, *descents)) {
      std::vector<PolishStart> elsewhere = Elsewhere(fit, descents->ends[before]);
      std::move(elsewhere.begin(), elsewhere.end(), std::back_inserter(neighbours));
    }
    if (neighbours.empty()) return;
    Descend(fit, std::move(neighbours), progress, descents);
    if (descents->best == before) return;
  }
}

// Reports the best end of each variant that has one.
std::vector<VariantReport> ReportVariants(const PreparedFit& fit, const Descents& descents) {
  std::vector<VariantReport> reports;
  if (fit.variants.size() < 2) return reports;
  const DescentEnd& best = descents.Best();
  const double points = static_cast<double>(fit.problem.voltage_V.size());
  for (std::size_t f = 0; f < fit.variants.size(); ++f) {
    const DescentEnd* lowest = nullptr;
    for (const DescentEnd& end : descents.ends) {
      const bool own = end.start.variant == static_cast<int>(f);
      if (own && (lowest == nullptr || end.value < lowest->value)) lowest = &end;
    }
    if (lowest == nullptr) continue;
    // Two ends in one local optimum may differ by rounding of repeated evaluations.
    const bool chosen = best.start.variant == static_cast<int>(f);
    if (chosen) lowest = &best;
    reports.push_back({DescribeVariant(*fit.problem.device.effects, fit.variants[f]),
                       fit.variants[f].free, std::sqrt(lowest->end.mean_square),
                       std::max(0.0, points * std::log(lowest->value / best.value)),
                       lowest->finished, chosen});
  }
  return reports;
}

// Starts of the best ends among those from the shape of the curve.
std::vector<PolishStart> BestShapes(const Descents& descents) {
  std::vector<const DescentEnd*> shapes;
  for (const DescentEnd& end : descents.ends) {
    if (end.start.origin.rfind(kShapeOrigin, 0) == 0) shapes.push_back(&end);
  }
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const DescentEnd* a, const DescentEnd* b) { return a->value < b->value; });
  std::vector<PolishStart> starts;
  for (std::size_t k = 0; k < std::min(kShapes, shapes.size()); ++k) {
    starts.push_back(shapes[k]->start);
  }
  return starts;
}

// Finds effects that the shape of the curve does not show. Starts first from settings spread over
// the best shape starts, then from probes near the best fit, repeatedly while it improves.
void ProbeBeside(const PreparedFit& fit, const std::vector<bool>& shapeless,
                 const ProgressReporter& progress, Descents* descents) {
  for (const PolishStart& shape : BestShapes(*descents)) {
    Descend(fit, SpreadSettings(fit, shape), progress, descents);
  }
  for (int round = 0; round < kFurther && !progress.stop().requested(); ++round) {
    const int before = descents->best;
    const DescentEnd best = descents->ends[before];
    const int variant = best.start.variant;
    std::vector<PolishStart> probes =
        Named("probe beside", variant,
              ProbesBeside(fit.problem, fit.variants[variant], best.end, shapeless, kProbes));
    for (PolishStart& probe : probes) probe.beside = true;
    Descend(fit, std::move(probes), progress, descents);
    if (descents->best == before) return;
  }
}

void TryStarts(const std::vector<PolishStart>& candidates, const SearchSpace& space,
               const PreparedFit& fit, const ProgressReporter& progress, Descents* descents) {
  const StartsFrom from = fit.options.starts;
  const std::vector<bool> shapeless = Shapeless(fit);
  const bool some = std::find(shapeless.begin(), shapeless.end(), true) != shapeless.end();
  const bool all = std::find(shapeless.begin(), shapeless.end(), false) == shapeless.end();
  const std::size_t first = from == StartsFrom::kAll ? 1 : kCandidates;
  const auto candidates_between = [&](std::size_t begin, std::size_t end) {
    return std::vector<PolishStart>(
        candidates.begin() + static_cast<std::ptrdiff_t>(std::min(begin, candidates.size())),
        candidates.begin() + static_cast<std::ptrdiff_t>(std::min(end, candidates.size())));
  };
  std::vector<PolishStart> starts;
  if (from != StartsFrom::kShape) starts = candidates_between(0, first);
  if (from != StartsFrom::kSearch) {
    std::vector<PolishStart> more = ShapeStarts(fit);
    if (more.empty()) {
      more = Named("probe", 0, ProbeStarts(fit.problem, fit.variants[0], kProbes));
    }
    std::move(more.begin(), more.end(), std::back_inserter(starts));
  }
  Descend(fit, std::move(starts), progress, descents);
  if (from != StartsFrom::kSearch && some && !all) ProbeBeside(fit, shapeless, progress, descents);
  if (from == StartsFrom::kShape) return;
  if (from == StartsFrom::kAll && LeavesNoise(fit, *descents)) return;
  if (BestVisits(*descents) < kAgain)
    Descend(fit, candidates_between(first, kCandidates), progress, descents);
  RandomStream random(fit.options.search.seed, ~fit.options.search.run);
  for (int round = 0; round < kFurther && !progress.stop().requested(); ++round) {
    if (BestVisits(*descents) >= kAgain && LeavesNoise(fit, *descents)) return;
    Descend(fit, RandomStarts(fit, space, descents->Best().end.p, &random), progress, descents);
  }
}

}  // namespace

ExtendedPolish PolishExtended(const PreparedFit& fit, const std::vector<PolishStart>& candidates,
                              const SearchSpace& space, const ProgressReporter& progress) {
  const Instant begin = Now();
  progress.BeginSilently("polish", 0);
  Descents descents;
  TryStarts(candidates, space, fit, progress, &descents);
  TryNeighbours(fit, progress, &descents);
  std::vector<PolishStart> starts;
  std::vector<RefineEnd> ends;
  for (const DescentEnd& end : descents.ends) {
    starts.push_back(end.start);
    ends.push_back(end.end);
  }
  ExtendedPolish polish;
  const std::vector<FitPoint> all(ends.begin(), ends.end());
  static_cast<PolishResult&>(polish) = ReportEnds(
      fit.problem, starts, std::move(ends), descents.best, progress.stop().requested(), begin);
  polish.ends = all;
  polish.report.local_optima = CountOptima(descents);
  polish.variants = ReportVariants(fit, descents);
  polish.variant = descents.Best().start.variant;
  return polish;
}

}  // namespace lyrefit
