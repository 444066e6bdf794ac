#include "lyrefit/estimate/fit/search_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/estimate/fit/check_candidates.h"
#include "lyrefit/estimate/fit/descent_starts.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

// RMSE of the points of the search space on the points of a problem, in the objective of the fit,
// in ampere. Space and problem must outlive the function.
ObjectiveFunction RmseIn(const SearchSpace& space, const RefineProblem& problem) {
  std::vector<double> p(problem.device.size());
  return [&space, &problem, p](const double* x) mutable {
    space.ToParameters(x, p.data());
    return std::sqrt(MeanSquare(problem, p));
  };
}

std::vector<double> DeviceAt(const SearchSpace& space, const PreparedFit& fit, const double* x) {
  std::vector<double> p(fit.problem.device.size());
  space.ToParameters(x, p.data());
  return p;
}

// Starts as points of the search space, sorted by rank within their variant: the best of each
// variant first, then the second of each. Costs one evaluation of the objective each.
std::vector<std::vector<double>> InitialPoints(const SearchSpace& space,
                                               const RefineProblem& problem,
                                               const std::vector<PolishStart>& starts) {
  struct Place {
    const PolishStart* start;
    double mean_square;
    int rank;  // within its variant
  };
  std::vector<Place> places;
  for (const PolishStart& start : starts) {
    places.push_back({&start, MeanSquare(problem, start.p), 0});
    if (!std::isfinite(places.back().mean_square)) places.pop_back();
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.mean_square < b.mean_square; });
  std::map<int, int> of_variant;
  for (Place& place : places) place.rank = of_variant[place.start->variant]++;
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.rank < b.rank; });
  std::vector<std::vector<double>> initial;
  initial.reserve(places.size());
  for (const Place& place : places) {
    initial.push_back(space.FromParameters(place.start->p.data(), place.start->variant));
  }
  return initial;
}

// RMSE of the best of as many random points as the search evaluated.
RmsePair RandomBaseline(const PreparedFit& fit, const SearchSpace& space, std::int64_t evaluations,
                        const Observer& observer, const ProgressReporter& progress) {
  SearchOptions random = fit.options.search;
  random.algorithm = Algorithm::kRandom;
  random.max_evaluations = std::max<std::int64_t>(evaluations, 4);
  random.target = -kInfinity;
  random.patience = 0;
  const SearchSummary baseline = Search(RmseIn(space, fit.coarse), space.box(), random, observer);
  if (baseline.termination == SearchTermination::kInterrupted) progress.stop().Request();
  return BothRmse(fit.device, DeviceAt(space, fit, baseline.best.x.data()), fit.curve);
}

}  // namespace

Expected<SearchedFit> SearchFit(const PreparedFit& fit, const SearchSpace& space,
                                const Observer& observer, const ProgressReporter& progress) {
  const FitOptions& options = fit.options;
  const Instant begin = Now();
  SearchedFit searched;
  Box box = space.box();
  if (options.search.algorithm == Algorithm::kMloShape) {
    const std::vector<PolishStart> starts = ShapeStarts(fit);
    box.initial = InitialPoints(space, fit.coarse, starts);
    searched.curve_evaluations = static_cast<std::int64_t>(starts.size());
  }
  const ObjectiveFunction objective = [&searched,
                                       rmse = RmseIn(space, fit.coarse)](const double* x) {
    ++searched.curve_evaluations;
    return rmse(x);
  };
  SearchSummary& summary = searched.summary;
  summary = options.searcher ? options.searcher(objective, box, options.search, observer)
                             : Search(objective, box, options.search, observer);
  summary.seconds = SecondsSince(begin);
  if (options.searcher || fit.coarse.points.size < fit.problem.points.size) {
    TRY(CheckCandidates(RmseIn(space, fit.problem), box, &summary));
  }
  if (summary.termination == SearchTermination::kInterrupted) progress.stop().Request();
  const bool is_random = options.search.algorithm == Algorithm::kRandom;
  if (options.random_baseline && !is_random && !progress.stop().requested()) {
    searched.random_baseline = RandomBaseline(fit, space, summary.evaluations, observer, progress);
  }
  for (const Candidate& candidate : summary.elites) {
    const std::size_t rank = searched.candidates.size() + 1;
    searched.candidates.push_back({rank == 1 ? "best candidate" : fmt::format("elite {}", rank),
                                   DeviceAt(space, fit, candidate.x.data()),
                                   space.VariantAt(candidate.x.data())});
  }
  return searched;
}

}  // namespace lyrefit
