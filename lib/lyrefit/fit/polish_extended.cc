#include "lyrefit/fit/polish_extended.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/fit/basin_starts.h"
#include "lyrefit/fit/probe_starts.h"
#include "lyrefit/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr std::size_t kProbes = 4;
constexpr std::size_t kCandidates = 3;
constexpr std::size_t kShapes = 3;
constexpr int kFurther = 3;  // of random places, and of probes beside the best
constexpr int kAgain = 2;    // ends in the best basin that make further rounds needless
constexpr int kSteps = 6;    // of whole numbers and settings

// Of each effect whether no shape of the curve shows where it is.
std::vector<bool> Shapeless(const FitJob& job) {
  std::vector<bool> shapeless;
  for (const EffectUse& use : job.problem.device.extension->uses) {
    shapeless.push_back(use.effect->starts == nullptr);
  }
  return shapeless;
}

// Whether the residuals of the best end are like noise (Durbin and Watson 1950,
// doi:10.1093/biomet/37.3-4.409): a better basin has nothing left to explain.
bool LeavesNoise(const FitJob& job, const Basins& basins) {
  constexpr double kLeast = 1.2;  // 2: each is independent of the next; 0: all are alike
  std::vector<double> residuals(job.problem.voltage_V.size());
  Residuals(job.problem, basins.ends()[basins.best()].end.p.data(), residuals.data(), nullptr);
  return FindResidualStatistics(job.problem.voltage_V, residuals).durbin_watson > kLeast;
}

void ClimbSettings(const FitJob& job, Basins* basins) {
  for (int step = 0; step < kSteps && !job.watch.stopped(); ++step) {
    const int before = basins->best();
    std::vector<PolishStart> neighbours = Neighbours(job, basins->ends()[before]);
    // Forms are told apart by less than noise.
    if (job.forms.size() > 1 || !LeavesNoise(job, *basins)) {
      std::vector<PolishStart> elsewhere = Elsewhere(job, basins->ends()[before]);
      std::move(elsewhere.begin(), elsewhere.end(), std::back_inserter(neighbours));
    }
    if (neighbours.empty()) return;
    basins->Descend(std::move(neighbours));
    if (basins->best() == before) return;
  }
}

// The best end of each form that has one.
std::vector<FormReport> ReportForms(const FitJob& job, const Basins& basins) {
  std::vector<FormReport> reports;
  if (job.forms.size() < 2) return reports;
  const BasinEnd& best = basins.ends()[basins.best()];
  const double points = static_cast<double>(job.problem.voltage_V.size());
  for (std::size_t f = 0; f < job.forms.size(); ++f) {
    const BasinEnd* lowest = nullptr;
    for (const BasinEnd& end : basins.ends()) {
      const bool own = end.start.form == static_cast<int>(f);
      if (own && (lowest == nullptr || end.paid < lowest->paid)) lowest = &end;
    }
    if (lowest == nullptr) continue;
    // Two ends of one basin may differ by the rounding of one evaluation or another.
    const bool chosen = best.start.form == static_cast<int>(f);
    if (chosen) lowest = &best;
    reports.push_back({DescribeForm(*job.problem.device.extension, job.forms[f]), job.forms[f].free,
                       std::sqrt(lowest->end.mean_square),
                       std::max(0.0, points * std::log(lowest->paid / best.paid)), lowest->finished,
                       chosen});
  }
  return reports;
}

// Where the best ends began that a shape suggested.
std::vector<PolishStart> BestShapes(const Basins& basins) {
  std::vector<const BasinEnd*> shapes;
  for (const BasinEnd& end : basins.ends()) {
    if (end.start.origin.rfind(kShapeOrigin, 0) == 0) shapes.push_back(&end);
  }
  std::stable_sort(shapes.begin(), shapes.end(),
                   [](const BasinEnd* a, const BasinEnd* b) { return a->paid < b->paid; });
  std::vector<PolishStart> starts;
  for (std::size_t k = 0; k < std::min(kShapes, shapes.size()); ++k) {
    starts.push_back(shapes[k]->start);
  }
  return starts;
}

// Effects that no shape shows: at settings spread over the places that a shape suggests, then
// beside the best fit so far, again and again as that gets better.
void ProbeBeside(const FitJob& job, const std::vector<bool>& shapeless, Basins* basins) {
  for (const PolishStart& shape : BestShapes(*basins)) {
    basins->Descend(SpreadSettings(job, shape));
  }
  for (int round = 0; round < kFurther && !job.watch.stopped(); ++round) {
    const int before = basins->best();
    const BasinEnd best = basins->ends()[before];
    const int form = best.start.form;
    std::vector<PolishStart> probes =
        Named("probe beside", form,
              ProbesBeside(job.problem, job.forms[form], best.end, shapeless, kProbes));
    for (PolishStart& probe : probes) probe.beside = true;
    basins->Descend(std::move(probes));
    if (basins->best() == before) return;
  }
}

void TryStarts(const std::vector<PolishStart>& candidates, const SearchSpace& space, const FitJob& job,
               Basins* basins) {
  const StartsFrom from = job.options.starts;
  const std::vector<bool> shapeless = Shapeless(job);
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
    std::vector<PolishStart> more = ShapeStarts(job);
    if (more.empty()) {
      more = Named("probe", 0, ProbeStarts(job.problem, job.forms[0], kProbes));
    }
    std::move(more.begin(), more.end(), std::back_inserter(starts));
  }
  basins->Descend(std::move(starts));
  if (from != StartsFrom::kSearch && some && !all) ProbeBeside(job, shapeless, basins);
  if (from == StartsFrom::kShape) return;
  if (from == StartsFrom::kAll && LeavesNoise(job, *basins)) return;
  if (basins->visits() < kAgain) basins->Descend(candidates_between(first, kCandidates));
  RandomStream random(job.options.search.seed, ~job.options.search.run);
  for (int round = 0; round < kFurther && !job.watch.stopped(); ++round) {
    if (basins->visits() >= kAgain && LeavesNoise(job, *basins)) return;
    basins->Descend(RandomStarts(job, space, basins->ends()[basins->best()].end.p, &random));
  }
}

}  // namespace

PolishResult PolishExtended(const std::vector<PolishStart>& candidates, const SearchSpace& space,
                            FitJob* job, FitReport* report) {
  const Instant begin = Now();
  job->watch.Begin("polish", 0);
  Basins basins(job->problem, job->forms, &job->watch);
  TryStarts(candidates, space, *job, &basins);
  ClimbSettings(*job, &basins);
  std::vector<PolishStart> starts;
  std::vector<RefineEnd> ends;
  for (const BasinEnd& end : basins.ends()) {
    starts.push_back(end.start);
    ends.push_back(end.end);
  }
  const std::vector<FitPoint> all(ends.begin(), ends.end());
  const BasinEnd best = basins.ends()[basins.best()];
  PolishResult result =
      ReportEnds(job->problem, starts, std::move(ends), basins.best(), job->watch.stopped(), begin);
  result.ends = all;
  result.report.basins = basins.Count();
  report->forms = ReportForms(*job, basins);
  SettleForm(best.start.form, best.end.p, job, report);
  return result;
}

}  // namespace lyrefit
