#include "lyrefit/study/reference.h"

#include <fmt/format.h>

#include "lyrefit/base/random.h"
#include "lyrefit/certify/certify.h"
#include "lyrefit/certify/floor.h"
#include "lyrefit/estimate/fit/usable.h"
#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare_run.h"
#include "lyrefit/study/problem_summary.h"

namespace lyrefit {
namespace {

// Largest number of convex problems in one proof. Without a proof the best of all runs is the
// reference.
constexpr std::int64_t kEffort = 20000;
constexpr std::int64_t kSolvedEffort = 4000;  // for the solved current, which takes longer for each

bool Within(const std::vector<double>& parameters, const std::vector<ParameterBounds>& bounds) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!(parameters[i] >= bounds[i].lower && parameters[i] <= bounds[i].upper)) return false;
  }
  return true;
}

}  // namespace

Reference FindReference(const CompareCurve& subject, Model model, const CompareOptions& options,
                        const BestFound& best, const Observer& observer) {
  Reference reference;
  reference.rmse_A = best.rmse_A;
  reference.origin = "best of all runs";
  reference.parameters = best.parameters;
  const Device device = MakeDevice(model, subject.curve.conditions, options.constants);
  auto bounds = MakeBounds(subject.bounds, device, subject.curve);
  if (!bounds) return reference;
  const std::vector<double> none_fixed(device.size(), kUnknown);
  reference.steepest_n = LeaveOutSteps(subject.curve, device, none_fixed, &*bounds);
  CertifyOptions certify = RangesOf(*bounds, options.constants, {model});
  certify.objective = options.objective;
  certify.effort = options.objective == Objective::kSolvedCurrent ? kSolvedEffort : kEffort;
  const auto certificate = Certify(subject.curve, certify, observer);
  if (!certificate) return reference;
  reference.interrupted = certificate->interrupted;
  if (reference.interrupted) {
    reference.origin += " so far";
    return reference;
  }
  const ModelCertificate& proof = certificate->models.at(0);
  reference.lower_bound_A = proof.lower_bound_A;
  if (certificate->floor.certified) reference.floor_A = certificate->floor.rmse_A;
  if (proof.rmse_A < reference.rmse_A && Within(proof.parameters, *bounds)) {
    reference.rmse_A = proof.rmse_A;
    reference.parameters = proof.parameters;
    reference.origin = "found by the proof";
  }
  const double gap = 1 - reference.lower_bound_A / reference.rmse_A;
  reference.certified = gap <= kCertifiedGap;
  if (reference.certified) {
    reference.origin = "certified optimum";
  } else {
    reference.origin += fmt::format("; proved lower bound {:.3g} % below", 100 * gap);
  }
  return reference;
}

namespace {

constexpr std::int64_t kLongSearch = 200;  // evaluations for each random point
constexpr int kFirstRun = 1000000000;      // outside the run numbers of all compared algorithms

// A search that consists of a single random point.
SearchSummary OnePoint(const ObjectiveFunction& objective, const Box& box,
                       const SearchOptions& options, const Observer& /*observer*/) {
  RandomStream random(options.seed, options.run);
  SearchSummary summary;
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    summary.best.x.push_back(box.lower[j] + random.Uniform() * (box.upper[j] - box.lower[j]));
  }
  summary.best.objective = objective(summary.best.x.data());
  summary.elites = {summary.best};
  summary.evaluations = 1;
  return summary;
}

}  // namespace

BestKnown FindBestKnown(const CompareCurve& subject, const ProblemResult& problem,
                        const CompareOptions& options, const Observer& observer) {
  BestKnown known;
  known.best.rmse_A = kInfinity;
  if (options.multistart == 0) return known;
  CompareOptions how = options;
  how.plain_polish = true;
  // End points of the fits from single points. `run` returns false if it was stopped. A failed fit
  // is ignored.
  std::vector<double> ends;
  const auto run = [&](const ComparedAlgorithm& compared, int number) {
    const bool point = compared.starts == StartsFrom::kSearch;
    how.polish = !point;
    const auto outcome = RunOnce(subject, problem, how, compared, kFirstRun + number, observer);
    if (!outcome) return true;
    if (!*outcome) return false;
    const BestFound found = BestOf({{**outcome}});
    if (point) ends.push_back((*outcome)->record.own_polished_A);
    if (!(found.rmse_A < known.best.rmse_A)) return true;
    known.best = found;
    known.found_by = compared.name;
    return true;
  };
  for (int k = 0; k < options.multistart && !known.interrupted; ++k) {
    ComparedAlgorithm point;
    point.name = fmt::format("random point {}", k + 1);
    point.search.elites = 1;
    point.starts = StartsFrom::kSearch;
    point.searcher = OnePoint;
    known.interrupted = !run(point, k);
  }
  const std::vector<Algorithm> algorithms = {Algorithm::kDe, Algorithm::kMlo, Algorithm::kRandom};
  for (const ComparedAlgorithm& long_search :
       BudgetAlgorithms(algorithms, {kLongSearch * options.multistart})) {
    if (known.interrupted) break;
    known.interrupted = !run(long_search, options.multistart);
  }
  known.points = static_cast<int>(ends.size());
  for (const double end : ends) known.visits += end <= known.best.rmse_A * (1 + kHit);
  return known;
}

Reference BestKnownReference(const BestFound& runs, const BestKnown& known) {
  Reference reference;
  const bool better = known.best.rmse_A < runs.rmse_A;
  reference.rmse_A = better ? known.best.rmse_A : runs.rmse_A;
  reference.parameters = better ? known.best.parameters : runs.parameters;
  reference.interrupted = known.interrupted;
  reference.origin = "best of all runs";
  if (known.points > 0) {
    const bool level = known.best.rmse_A <= reference.rmse_A * (1 + kHit);
    reference.by_multistart = known.best.rmse_A * (1 + kHit) < runs.rmse_A;
    reference.points = known.points;
    reference.visits = level ? known.visits : 0;
    reference.origin +=
        fmt::format(" and of a multistart; {}, where {} of {} random points ended as well",
                    better ? "found by its " + known.found_by : std::string("found by a run"),
                    reference.visits, reference.points);
  }
  if (known.interrupted) reference.origin += " so far";
  return reference;
}

}  // namespace lyrefit
