#include "lyrefit/family/fit_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/family/curve_subset.h"
#include "lyrefit/family/family_effects.h"
#include "lyrefit/family/family_errors.h"
#include "lyrefit/family/family_held_out.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/family/family_warnings.h"
#include "lyrefit/family/family_weights.h"
#include "lyrefit/family/individual_fits.h"
#include "lyrefit/family/joint_fit.h"
#include "lyrefit/family/outlier_curves.h"
#include "lyrefit/fit/statistics.h"
#include "lyrefit/law/extended_set.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/law/model_points.h"

namespace lyrefit {
namespace {

constexpr int kMostJackknifed = 60;  // curves; a jackknife of more adds little and takes long

// Data passed between the stages of one family fit.
struct Job {
  const CurveSet& set;
  const FamilyOptions& options;
  const Observer& observer;
  FamilyProblem family;
  std::vector<int> search_curves;
  IndividualFits free;
  std::vector<JointPoint> starts;  // the search's elites first, then others
  std::ptrdiff_t elites = 0;
  JointPoint searched;
  bool stopped = false;
};

FitOptions SingleFitOptions(const FamilyOptions& options) {
  FitOptions fit = OwnFitOptions(options);
  fit.search.seed = options.search.seed;
  // One curve hardly determines two idealities; the law fixes the second one as well.
  if (options.model == Model::kDoubleDiode) fit.fixed["n2"] = 2;
  return fit;
}

void DescribeCurves(const Job& job, FamilyReport* report) {
  for (std::size_t c = 0; c < job.set.curves.size(); ++c) {
    const FamilyMember& member = job.family.curves.members[c];
    FamilyCurve row = DescribeCurve(job.set.curves[c]);
    row.role = member.role;
    row.reason = member.reason;
    row.short_circuit_current_A = member.short_circuit_current_A;
    if (member.role != CurveRole::kLeftOut) {
      row.irradiance_W_m2 = member.joint.irradiance_W_m2;
      row.temperature_C = member.joint.temperature_K - kZeroCelsius_K;
    }
    report->curves.push_back(std::move(row));
  }
}

void FitFreely(Job* job, FamilyReport* report) {
  std::vector<const IvCurve*> curves;
  std::vector<int> rows;
  // The individual fits of the search curves run even if the floor is not requested, since they
  // give starts of the joint fit.
  std::vector<int> wanted = job->search_curves;
  if (job->options.individual_fits) {
    wanted = job->family.curves.fitted;
    const std::vector<int>& held = job->family.curves.held_out;
    wanted.insert(wanted.end(), held.begin(), held.end());
  }
  for (const int c : wanted) {
    curves.push_back(&job->set.curves[c]);
    rows.push_back(c);
  }
  job->free =
      FitEveryCurve(curves, SingleFitOptions(job->options), job->options.threads, job->observer);
  job->stopped = job->stopped || job->free.interrupted;
  report->individual_seconds = job->free.seconds;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::optional<Expected<FitReport>>& one = job->free.reports[k];
    if (!one || !*one) continue;
    FamilyCurve& row = report->curves[rows[k]];
    FillIndividualFit(**one, &row);
    const std::vector<int>& search = job->search_curves;
    const FamilyMember& member = job->family.curves.members[rows[k]];
    if (std::find(search.begin(), search.end(), rows[k]) == search.end()) continue;
    if (member.IsDark()) continue;
    std::vector<double> start =
        StartFromIndividualFit(job->family, member.joint, row.individual_parameters);
    if (!start.empty()) job->starts.push_back({std::move(start), {}});
  }
}

Expected<void> SearchShared(Job* job, FamilyReport* report) {
  TRY(const FamilySearchEnd end,
      SearchFamily(job->family, job->options, job->search_curves, job->observer));
  job->stopped = end.summary.termination == SearchTermination::kInterrupted;
  report->search = end.summary;
  for (const int c : job->search_curves) report->search_ids.push_back(job->set.curves[c].name);
  const JointProblem problem = JointProblemOn(job->family, job->options, job->search_curves);
  job->searched = end.elites[0];
  report->rmse.searched = FamilyRmse(problem, job->searched);
  if (end.has_random) report->rmse.random_baseline = FamilyRmse(problem, end.random);
  job->starts = end.elites;
  job->elites = static_cast<std::ptrdiff_t>(end.elites.size());
  const std::vector<double>& shared = job->searched.shared;
  report->searched.assign(shared.begin(), shared.begin() + job->family.translation.size());
  return {};
}

// Polishes the best candidate alone and reports both results.
void FollowCandidate(Job* job, const JointProblem& problem, FamilyReport* report) {
  const CandidateEnds ends = PolishCandidate(job->family, job->options, job->search_curves,
                                             job->searched, job->observer, problem);
  report->rmse.plain_polished = FamilyRmse(problem, ends.plain.point);
  report->rmse.refined_best_candidate = FamilyRmse(problem, ends.own.point);
  const Translation& at = job->family.translation;
  report->refined_best_candidate =
      at.extended ? ReportedShared(at, ends.own.point.shared) : ends.own.point.shared;
  report->refined_best_candidate.resize(at.size());
  report->plain_seconds = ends.plain_seconds;
  report->best_candidate_seconds = ends.own_seconds;
  job->stopped = job->stopped || ends.plain.stopped || ends.own.stopped;
}

// Fills the differences of the individual fit from the shared parameters.
void FillExcess(const TranslatedDevice& shared, FamilyCurve* row) {
  if (row->individual_parameters.size() != shared.parameters.size()) return;
  const KeyPoints model = ModelKeyPoints(shared.device, shared.parameters.data());
  const KeyPoints own = ModelKeyPoints(shared.device, row->individual_parameters.data());
  row->isc_excess = own.short_circuit_current_A / model.short_circuit_current_A - 1;
  row->voc_excess_V = own.open_circuit_voltage_V - model.open_circuit_voltage_V;
}

void FillCurves(const Job& job, const JointProblem& problem, const JointEnd& end,
                FamilyReport* report) {
  const auto fill = [&](const JointProblem& from, const JointPoint& point, int k, int c) {
    FamilyCurve& row = report->curves[c];
    const IvCurve& curve = job.set.curves[c];
    row.rmse = CurveRmse(from, point, k);
    const TrueConditions at = ConditionsAt(from, point, k);
    const TranslatedDevice device =
        TranslateTo(job.family.translation, report->refined, at.irradiance_W_m2, at.temperature_K);
    row.parameters = device.parameters;
    std::vector<double> model;
    if (job.family.translation.extended) {
      model = SolveCurrents(DeviceOf(from, k), DeviceAt(from, point, k).data(),
                            MakePointSet(curve.voltage_V, curve.current_A));
    } else {
      FillExcess(device, &row);
      model = SolveCurrents(device.device, row.parameters.data(), curve.voltage_V);
    }
    double sum = 0;
    for (std::size_t i = 0; i < model.size(); ++i) {
      row.residual_A.push_back(model[i] - curve.current_A[i]);
      sum += row.residual_A.back();
    }
    row.mean_residual_A = sum / static_cast<double>(model.size());
  };
  const std::vector<int>& fitted = job.family.curves.fitted;
  for (std::size_t k = 0; k < fitted.size(); ++k) {
    fill(problem, end.point, static_cast<int>(k), fitted[k]);
  }
  const std::vector<int>& held = job.family.curves.held_out;
  if (held.empty()) return;
  const JointProblem rest = JointProblemOn(job.family, job.options, held);
  const JointPoint point{end.point.shared, std::vector<JointLocal>(held.size(), {0, 0})};
  for (std::size_t k = 0; k < held.size(); ++k) {
    fill(rest, point, static_cast<int>(k), held[k]);
  }
}

void FindOutlier(Job* job, const JointProblem& problem, const JointEnd& end, FamilyReport* report) {
  // The test frees the irradiance and temperature of a curve, which a curve with effects does not
  // have as unknowns.
  if (job->family.translation.extended) return;
  const ProgressReporter progress(job->observer, "outlier curves", 0);
  const std::vector<int> outlier = FindOutlierCurves(problem, end, progress.stop());
  job->stopped = progress.Stopped();
  if (outlier.empty() || job->stopped) return;
  WithoutOutliers without;
  JointProblem rest = problem;
  JointPoint start = end.point;
  for (auto c = outlier.rbegin(); c != outlier.rend(); ++c) {
    rest.curves.erase(rest.curves.begin() + *c);
    start.local.erase(start.local.begin() + *c);
  }
  JointOptions options;
  options.stop = progress.stop();
  const JointEnd refit = RefineJointly(rest, start, options);
  job->stopped = refit.stopped;
  if (job->stopped) return;
  for (const int c : outlier) {
    FamilyCurve& row = report->curves[job->family.curves.fitted[c]];
    row.outlier = true;
    without.ids.push_back(row.id);
  }
  const std::vector<double>& shared = refit.point.shared;
  without.rmse = FamilyRmse(rest, refit.point);
  without.shared.assign(shared.begin(), shared.begin() + job->family.translation.size());
  report->without_outliers = std::move(without);
}

FamilyReport Head(const Job& job) {
  FamilyReport report;
  report.version = Version();
  report.name = job.set.name;
  report.source = job.set.source;
  report.translation = job.family.translation;
  report.objective = job.options.objective;
  report.cells_in_series = job.family.translation.spec.cells_in_series;
  report.rejected = job.set.rejected;
  report.assumptions = SentencesOf(job.set.assumptions);
  report.assumptions.insert(report.assumptions.end(), job.family.notes.begin(),
                            job.family.notes.end());
  report.search_options = job.options.search;
  report.non_default_options = NonDefaults(job.options, kFamilyOptionTable);
  report.with = job.options.with;
  const std::optional<Device>& extended = job.family.translation.extended;
  if (extended) report.taken = extended->effects->set;
  report.termination = "not run";
  return report;
}

// Fixes the integer-valued parameters at the values that the starts selected.
void SettleWhole(const std::vector<double>& shared, FamilyProblem* family) {
  for (std::size_t i = 0; i < family->bounds.size(); ++i) {
    if (family->bounds[i].whole == 0) continue;
    const double at = family->fixed[i] = shared[i];
    family->bounds[i] = {at, at, at, at, SearchScale::kLinear};
  }
}

void Refine(Job* job, FamilyReport* report) {
  JointProblem problem = JointProblemOn(job->family, job->options, job->family.curves.fitted);
  JointPoint candidate = job->searched;
  candidate.local.assign(problem.curves.size(), {0, 0});
  report->rmse.searched_all = FamilyRmse(problem, candidate);
  if (job->options.plain_polish) FollowCandidate(job, problem, report);
  const Instant begin = Now();
  job->starts = ChooseStarts(job->family, job->options, job->search_curves, std::move(job->starts),
                             job->elites, job->observer);
  JointEnd end = FitJointly(job->family, job->options, job->search_curves, job->starts,
                            job->observer, &problem);
  const WeightChoice weights =
      SettleWeights(job->options, job->observer, &job->family, &problem, &end);
  report->weights = weights.used;
  report->weights_gain = weights.gain;
  SettleWhole(end.point.shared, &job->family);
  report->joint_seconds = SecondsSince(begin);
  report->termination = end.stopped     ? "interrupted"
                        : end.converged ? "converged"
                                        : "no convergence";
  report->projected_gradient = end.projected_gradient;
  report->rmse.refined = FamilyRmse(problem, end.point);
  const ReportedFit reported(job->family, problem, end);
  JudgeFamily(reported, job->options, job->observer, report);
  if (job->options.intervals && !report->interrupted) {
    const std::vector<int>& held = job->family.curves.held_out;
    FindFamilyIntervals(reported, JointProblemOn(job->family, job->options, held), report);
  }
  FillCurves(*job, problem, end, report);
  job->stopped = job->stopped || end.stopped || report->interrupted;
  if (!job->stopped) {
    TestFamily(job->set, job->family, job->options, problem, end, job->observer, report);
    job->stopped = report->interrupted;
  }
  if (!job->stopped) FindOutlier(job, problem, end, report);
  const std::size_t curves = problem.curves.size();
  if (job->options.intervals && curves > 2 && curves <= kMostJackknifed && !job->stopped) {
    Jackknife(job->family, problem, end, job->options.threads, job->observer, report);
    job->stopped = report->interrupted;
  }
}

// Builds the problem and checks that it can be fitted.
Expected<FamilyProblem> CheckedProblem(const CurveSet& set, const FamilyOptions& options) {
  TRY(ValidateThreads(options.threads));
  TRY(FamilyProblem family, MakeFamilyProblem(set, options));
  TRY(CheckAgainst(family, options));
  std::size_t points = 0;
  for (const int c : family.curves.fitted) points += set.curves[c].size();
  if (static_cast<int>(points) <= family.free_parameters) {
    return Fail(fmt::format("{} points cannot determine {} shared parameters", points,
                            family.free_parameters),
                set.source);
  }
  return family;
}

}  // namespace

Expected<Translation> CheckFamily(const CurveSet& set, const FamilyOptions& options) {
  TRY(FamilyProblem family, CheckedProblem(set, options));
  return std::move(family.translation);
}

Expected<FamilyReport> FitFamily(const CurveSet& set, const FamilyOptions& options,
                                 const Observer& observer) {
  const Instant begin = Now();
  TRY(FamilyProblem family, CheckedProblem(set, options));
  Job job{set, options, observer, std::move(family), {}, {}, {}, 0, {}, false};
  const std::vector<int>& fitted = job.family.curves.fitted;
  job.search_curves = CurveSubset(ConditionsOf(job.family.curves), fitted, options.search_curves);
  FamilyReport report = Head(job);
  DescribeCurves(job, &report);
  TRY(SearchShared(&job, &report));
  if (!job.stopped) FitFreely(&job, &report);
  if (!job.stopped) {
    Refine(&job, &report);
  } else {
    report.refined = report.searched;
  }
  report.interrupted = job.stopped;
  report.doubts = DoubtsOfKept(set, report);
  report.warnings = report.doubts;
  const std::vector<std::string> found = FamilyWarnings(report, options);
  report.warnings.insert(report.warnings.end(), found.begin(), found.end());
  const double isc = job.family.curves.reference_current_A;
  const double solved = report.rmse.refined.solved_current_A;
  report.usable = std::isfinite(solved) && solved < 0.2 * isc;
  report.seconds = SecondsSince(begin);
  return report;
}

}  // namespace lyrefit
