#include "lyrefit/fit/polish_extended.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "lyrefit/base/random.h"
#include "lyrefit/fit/form_problem.h"
#include "lyrefit/fit/probe_starts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kProbes = 4;
constexpr std::size_t kBirds = 3;
constexpr int kRounds = 3;  // of random places
constexpr int kDrawn = 40;  // in a round
constexpr std::size_t kKept = 4;
constexpr int kAgain = 2;  // ends in the best basin that make further rounds needless
constexpr int kSteps = 6;  // of whole numbers

std::vector<PolishStart> ShapeStarts(const FitJob& job) {
  std::vector<PolishStart> starts;
  for (std::size_t f = 0; f < job.forms.size(); ++f) {
    for (const std::vector<double>& place :
         ShapePlaces(*job.problem.device.extension, job.forms[f])) {
      starts.push_back({fmt::format("shape {}", starts.size() + 1),
                        TypicalDevice(job.problem, place), static_cast<int>(f)});
    }
  }
  return starts;
}

std::vector<PolishStart> Named(const std::string& origin, int form,
                               std::vector<std::vector<double>> places) {
  std::vector<PolishStart> starts;
  for (std::vector<double>& place : places) {
    starts.push_back({fmt::format("{} {}", origin, starts.size() + 1), std::move(place), form});
  }
  return starts;
}

// Of each effect whether no shape of the curve shows where it is.
std::vector<bool> Shapeless(const FitJob& job) {
  std::vector<bool> shapeless;
  for (const EffectUse& use : job.problem.device.extension->uses) {
    shapeless.push_back(use.effect->starts == nullptr);
  }
  return shapeless;
}

// The best of many random places, none of them beside another.
std::vector<PolishStart> RandomStarts(const FitJob& job, const SearchSpace& space,
                                      RandomStream* random) {
  constexpr double kBeside = 0.1;  // of a side, in all of them
  const Box& box = space.box();
  std::vector<std::pair<double, std::vector<double>>> drawn;
  std::vector<double> p(job.problem.device.size());
  for (int k = 0; k < kDrawn; ++k) {
    std::vector<double> x(space.dimensions());
    for (std::size_t j = 0; j < x.size(); ++j) {
      x[j] = box.lower[j] + random->Uniform() * (box.upper[j] - box.lower[j]);
    }
    space.ToParameters(x.data(), p.data());
    const double mean_square = MeanSquare(job.few, p);
    if (std::isfinite(mean_square)) drawn.emplace_back(mean_square, std::move(x));
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PolishStart> starts;
  std::vector<std::vector<double>> kept;
  for (auto& [mean_square, x] : drawn) {
    if (starts.size() == kKept) break;
    const bool crowded = std::any_of(kept.begin(), kept.end(), [&](const auto& other) {
      for (std::size_t j = 0; j < other.size(); ++j) {
        if (std::fabs(x[j] - other[j]) > kBeside * (box.upper[j] - box.lower[j])) return false;
      }
      return true;
    });
    if (crowded) continue;
    space.ToParameters(x.data(), p.data());
    starts.push_back({"random", p, space.FormAt(x.data())});
    kept.push_back(std::move(x));
  }
  return starts;
}

// One more or less of each whole number, and one less of one for one more of another.
std::vector<PolishStart> Neighbours(const FitJob& job, const BasinEnd& at) {
  const Form& form = job.forms[at.start.form];
  const int first = job.base_size();
  std::vector<std::pair<int, double>> steps;
  for (int k = 0; k < job.effects(); ++k) {
    if (form.bounds[k].whole == 0) continue;
    steps.emplace_back(first + k, form.bounds[k].whole);
    steps.emplace_back(first + k, -form.bounds[k].whole);
  }
  std::vector<PolishStart> starts;
  const auto add = [&](std::vector<double> p) {
    const std::vector<double> wanted = p;
    for (int k = 0; k < job.effects(); ++k) {
      p[first + k] = WithinBounds(form.bounds[k], p[first + k]);
    }
    LeaveARest(*job.problem.device.extension, form.bounds, p.data() + first);
    if (p == wanted) starts.push_back({"one more or less", std::move(p), at.start.form});
  };
  for (const auto& [i, step] : steps) {
    std::vector<double> p = at.end.p;
    p[i] += step;
    add(p);
    for (const auto& [other, back] : steps) {
      if (other == i || !(step > 0) || !(back < 0)) continue;
      std::vector<double> both = p;
      both[other] += back;
      add(both);
    }
  }
  return starts;
}

void ClimbWholeNumbers(const FitJob& job, Basins* basins) {
  for (int step = 0; step < kSteps; ++step) {
    const int before = basins->best();
    std::vector<PolishStart> neighbours = Neighbours(job, basins->ends()[before]);
    if (neighbours.empty()) return;
    basins->Descend(std::move(neighbours));
    if (basins->best() == before) return;
  }
}

// The best end of each form that has one.
std::vector<FormReport> ReportForms(const FitJob& job, const Basins& basins) {
  std::vector<FormReport> reports;
  if (job.forms.size() < 2) return reports;
  const double best = basins.ends()[basins.best()].paid;
  const double points = static_cast<double>(job.problem.voltage_V.size());
  for (std::size_t f = 0; f < job.forms.size(); ++f) {
    const BasinEnd* lowest = nullptr;
    for (const BasinEnd& end : basins.ends()) {
      const bool own = end.start.form == static_cast<int>(f);
      if (own && (lowest == nullptr || end.paid < lowest->paid)) lowest = &end;
    }
    if (lowest == nullptr) continue;
    reports.push_back({DescribeForm(*job.problem.device.extension, job.forms[f]), job.forms[f].free,
                       std::sqrt(lowest->end.mean_square), points * std::log(lowest->paid / best),
                       lowest->finished, lowest->paid == best});
  }
  return reports;
}

void TryStarts(const std::vector<PolishStart>& birds, const SearchSpace& space, const FitJob& job,
               Basins* basins) {
  const StartsFrom from = job.options.starts;
  const std::vector<bool> shapeless = Shapeless(job);
  const bool some = std::find(shapeless.begin(), shapeless.end(), true) != shapeless.end();
  const bool none = std::find(shapeless.begin(), shapeless.end(), false) == shapeless.end();
  std::vector<PolishStart> starts;
  const auto add = [&](std::vector<PolishStart> more) {
    starts.insert(starts.end(), std::make_move_iterator(more.begin()),
                  std::make_move_iterator(more.end()));
  };
  if (from != StartsFrom::kShape) {
    add({birds.begin(),
         birds.begin() + static_cast<std::ptrdiff_t>(std::min(kBirds, birds.size()))});
  }
  if (from != StartsFrom::kSearch) {
    add(ShapeStarts(job));
    if (none || starts.empty()) {
      add(Named("probe", 0, ProbeStarts(job.problem, job.forms[0], kProbes)));
    }
  }
  basins->Descend(std::move(starts));
  if (from != StartsFrom::kSearch && some && !none && !job.watch.stopped()) {
    const BasinEnd& best = basins->ends()[basins->best()];
    const int form = best.start.form;
    basins->Descend(
        Named("probe beside", form,
              ProbesBeside(job.problem, job.forms[form], best.end.p, shapeless, kProbes)));
  }
  if (from == StartsFrom::kShape) return;
  RandomStream random(job.options.search.seed, ~job.options.search.run);
  for (int round = 0; round < kRounds && basins->visits() < kAgain; ++round) {
    if (job.watch.stopped()) return;
    basins->Descend(RandomStarts(job, space, &random));
  }
}

}  // namespace

PolishResult PolishExtended(const std::vector<PolishStart>& birds, const SearchSpace& space,
                            FitJob* job, FitReport* report) {
  const auto begin = std::chrono::steady_clock::now();
  job->watch.Begin("polish", 0);
  Basins basins(job->problem, job->forms, &job->watch);
  TryStarts(birds, space, *job, &basins);
  ClimbWholeNumbers(*job, &basins);
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
