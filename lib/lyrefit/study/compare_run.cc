#include "lyrefit/study/compare_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/search_space.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {
namespace {

FitOptions FitOptionsOf(const CompareCurve& subject, const ProblemResult& problem,
                        const CompareOptions& options) {
  FitOptions fit;
  fit.model = problem.model;
  fit.objective = problem.objective;
  fit.constants = options.constants;
  fit.bounds = subject.bounds;
  fit.with = problem.with;
  fit.force_effects = options.force_effects;
  fit.random_baseline = false;
  fit.polish = options.polish;
  fit.plain_polish = options.plain_polish;
  fit.intervals = Intervals::kNone;
  fit.threads = 1;
  fit.kernel = options.kernel;
  return fit;
}

// Family options with everything switched off that a comparison does not use.
FamilyOptions FamilyOptionsOf(const CompareCurve& subject, const CompareOptions& options) {
  FamilyOptions family = subject.family;
  family.plain_polish = options.plain_polish;
  family.random_baseline = false;
  family.intervals = false;
  family.individual_fits = false;
  family.folds = 0;
  family.threads = 1;
  return family;
}

// Sets the search of an algorithm in `fit`, a FitOptions or a FamilyOptions.
template <class Options>
void SetAlgorithm(const ComparedAlgorithm& compared, const CompareOptions& options, int run,
                  Options* fit) {
  if (compared.kind != AlgorithmKind::kDefault) fit->search = compared.search;
  if (compared.kind != AlgorithmKind::kSearch) fit->plain_polish = false;
  fit->starts = compared.starts;
  fit->search.seed = options.seed;
  fit->search.run = static_cast<std::uint64_t>(run);
  fit->searcher = compared.searcher;
}

void FillSearch(const SearchSummary& search, int run, RunOutcome* outcome) {
  outcome->record.run = run;
  outcome->record.evaluations = outcome->record.curve_evaluations = search.evaluations;
  outcome->record.search_seconds = search.seconds;
}

// RMSE of the best candidate's own polish. It is computed here if no other start was polished.
double OwnPolish(const FitReport& report, const ProblemResult& problem) {
  const std::vector<double>& p = report.refined_best_candidate;
  if (report.polished || problem.problem.empty() || p.empty()) {
    return report.rmse.refined_best_candidate.Of(problem.objective);
  }
  return Rmse(report.device, problem.objective, p.data(), report.curve.voltage_V,
              report.curve.current_A);
}

RunOutcome OutcomeOf(const FitReport& report, const ProblemResult& problem, int run) {
  const Objective objective = problem.objective;
  RunOutcome outcome;
  FillSearch(report.search, run, &outcome);
  RunRecord& record = outcome.record;
  record.curve_evaluations = report.curve_evaluations;
  const double candidate = report.best_candidate_penalty;
  record.searched_A = report.rmse.searched.Of(objective) * candidate;
  record.plain_polished_A = report.rmse.plain_polished.Of(objective) * candidate;
  record.own_polished_A = OwnPolish(report, problem) * candidate;
  record.polished_A = report.rmse.refined.Of(objective) * report.variant_penalty;
  record.polish_seconds = report.refine.seconds;
  record.plain_seconds = report.plain_seconds;
  record.own_seconds = report.refine.best_candidate_seconds;
  outcome.gains = KeepGains(report.search.trace);
  if (outcome.gains.empty()) {  // a user-defined search may have no trace
    outcome.gains.push_back({0, report.search.evaluations, record.searched_A});
  }
  for (const Estimate& e : report.estimates) {
    outcome.parameters.push_back(report.polished ? e.refined : e.searched);
  }
  if (!problem.problem.empty() && !report.refined_best_candidate.empty()) {
    outcome.own_parameters = Reported(report.device, report.refined_best_candidate);
  }
  return outcome;
}

RunOutcome OutcomeOf(const FamilyReport& report, const ProblemResult& problem, int run) {
  const Objective objective = problem.objective;
  RunOutcome outcome;
  FillSearch(report.search, run, &outcome);
  RunRecord& record = outcome.record;
  record.searched_A = report.searched_all.Of(objective);
  record.plain_polished_A = report.rmse.plain_polished.Of(objective);
  record.own_polished_A = report.rmse.refined_best_candidate.Of(objective);
  record.polished_A = report.rmse.refined.Of(objective);
  record.polish_seconds = report.individual_seconds + report.refine.seconds;
  record.plain_seconds = report.plain_seconds;
  record.own_seconds = report.refine.best_candidate_seconds;
  // The search used only some of the curves, so its trace is not comparable with the reference.
  outcome.gains.push_back({0, report.search.evaluations, record.searched_A});
  for (const Estimate& e : report.estimates) outcome.parameters.push_back(e.refined);
  outcome.own_parameters = report.refined_best_candidate;
  return outcome;
}

// The problem with its parameter names and the position of the first effect parameter.
ProblemResult WithNames(ProblemResult problem, const CompareCurve& subject,
                        const CompareOptions& options) {
  std::vector<ParameterInfo> infos;
  if (subject.set) {
    const auto law = CheckFamily(*subject.set, subject.family);
    if (!law) return problem;  // TryProblem() reports the error
    infos = law->parameters;
    problem.first_effect = law->first_effect;
  } else {
    infos = MakeDevice(problem.model, subject.curve.conditions, options.constants).parameters;
    if (!problem.with.empty()) problem.first_effect = static_cast<int>(infos.size());
    AddInfos(problem.with, &infos);
    const FitOptions fit = FitOptionsOf(subject, problem, options);
    const auto prepared = PrepareFit(subject.curve, fit);
    if (!prepared) return problem;  // TryProblem() reports the error
    const SearchSpace space = SpaceOf(*prepared);
    for (const BoxSide& side : space.box().sides) {
      if (side.log_base > 0) problem.log_searched.push_back(side.name);
    }
  }
  for (const ParameterInfo& info : infos) problem.parameters.push_back(ParameterKey(info));
  return problem;
}

}  // namespace

ProblemResult DescribeProblem(const CompareCurve& subject, Model model,
                              const CompareOptions& options) {
  ProblemResult problem;
  problem.family = subject.set.has_value();
  problem.curve_name = problem.family ? subject.set->name : subject.curve.name;
  problem.model = problem.family ? subject.family.model : subject.model.value_or(model);
  problem.bounds_name = subject.bounds.name;
  problem.with = problem.family         ? subject.family.with
                 : subject.with.empty() ? options.with
                                        : subject.with;
  problem.objective = subject.objective.value_or(options.objective);
  if (problem.family) problem.objective = subject.family.objective;
  if (!problem.with.empty()) problem.objective = Objective::kSolvedCurrent;
  problem.problem = subject.problem;
  if (problem.problem.empty() && (problem.family || !problem.with.empty())) {
    problem.problem = problem.curve_name;
    if (options.models.size() > 1) problem.problem += " " + ToText(problem.model);
  }
  return WithNames(std::move(problem), subject, options);
}

Expected<void> TryProblem(const CompareCurve& subject, const ProblemResult& problem,
                          const CompareOptions& options) {
  if (problem.family) {
    const auto law = CheckFamily(*subject.set, FamilyOptionsOf(subject, options));
    if (!law) return tl::unexpected(law.error());
    return {};
  }
  FitOptions fit = FitOptionsOf(subject, problem, options);
  fit.polish = fit.plain_polish = false;
  fit.search.population = 4;
  fit.search.max_evaluations = 4;
  const auto report = Fit(subject.curve, fit);
  if (!report) return tl::unexpected(report.error());
  return {};
}

Expected<std::optional<RunOutcome>> RunOnce(const CompareCurve& subject,
                                            const ProblemResult& problem,
                                            const CompareOptions& options,
                                            const ComparedAlgorithm& compared, int run,
                                            const Observer& observer) {
  std::optional<RunOutcome> outcome;
  if (problem.family) {
    FamilyOptions family = FamilyOptionsOf(subject, options);
    SetAlgorithm(compared, options, run, &family);
    const auto report = FitFamily(*subject.set, family, observer);
    if (!report) return tl::unexpected(report.error());
    if (!report->interrupted) outcome = OutcomeOf(*report, problem, run);
    return outcome;
  }
  FitOptions fit = FitOptionsOf(subject, problem, options);
  if (!problem.with.empty()) fit.search = FitOptions::SearchBesideShapes();
  SetAlgorithm(compared, options, run, &fit);
  const auto report = Fit(subject.curve, fit, observer);
  if (!report) return tl::unexpected(report.error());
  if (!report->interrupted) outcome = OutcomeOf(*report, problem, run);
  return outcome;
}

namespace {

constexpr int kMostRuns = 1000000;

Expected<void> CheckOptions(std::size_t curves, std::size_t algorithms,
                            const CompareOptions& options) {
  if (curves == 0) return Fail("no curve to compare on");
  if (options.models.empty()) return Fail("no model to compare on");
  for (auto model = options.models.begin(); model != options.models.end(); ++model) {
    if (std::find(options.models.begin(), model, *model) == model) continue;
    return Fail(fmt::format("the model {} is named twice", ToText(*model)));
  }
  if (options.runs < 1 || options.runs > kMostRuns) {
    return Fail(fmt::format("runs = {} is outside [1, {}]", options.runs, kMostRuns));
  }
  if (options.multistart < 0 || options.multistart > kMostRuns) {
    return Fail(fmt::format("multistart = {} is outside [0, {}]", options.multistart, kMostRuns));
  }
  if (auto threads = ValidateThreads(options.threads); !threads) return threads;
  if (!(options.target_gap > 0 && options.target_gap < kInfinity)) {
    return Fail(fmt::format("target-gap = {:g} must be above 0", options.target_gap));
  }
  const double jobs = static_cast<double>(curves) * static_cast<double>(options.models.size()) *
                      static_cast<double>(algorithms) * options.runs;
  if (jobs > std::numeric_limits<int>::max()) return Fail("more than 2147483647 runs in all");
  return {};
}

Expected<void> CheckAlgorithms(const std::vector<ComparedAlgorithm>& algorithms) {
  if (algorithms.empty()) return Fail("no algorithm to compare");
  for (auto compared = algorithms.begin(); compared != algorithms.end(); ++compared) {
    if (compared->name.empty()) return Fail("an algorithm has no name");
    const bool twice =
        std::any_of(algorithms.begin(), compared,
                    [&](const ComparedAlgorithm& other) { return other.name == compared->name; });
    if (twice) return Fail(fmt::format("the algorithm {} is named twice", compared->name));
    if (auto valid = ValidateOptions(compared->search, kSearchOptionTable); !valid) {
      return Fail(fmt::format("{}: {}", compared->name, valid.error().message));
    }
  }
  return {};
}

}  // namespace

Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<ComparedAlgorithm>& algorithms,
                               const CompareOptions& options) {
  if (auto checked = CheckAlgorithms(algorithms); !checked) return checked;
  return CheckOptions(curves.size(), algorithms.size(), options);
}

}  // namespace lyrefit
