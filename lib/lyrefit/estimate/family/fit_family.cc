#include "lyrefit/estimate/family/fit_family.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/estimate/family/family_errors.h"
#include "lyrefit/estimate/family/family_held_out.h"
#include "lyrefit/estimate/family/family_judge.h"
#include "lyrefit/estimate/family/family_warnings.h"
#include "lyrefit/estimate/family/outlier_curves.h"
#include "lyrefit/estimate/family/refine_family.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr int kMostJackknifed = 60;  // curves; a jackknife of more adds little and takes long

std::vector<FamilyCurve> DescribeCurves(const PreparedFamily& prepared) {
  std::vector<FamilyCurve> rows;
  rows.reserve(prepared.set.curves.size());
  for (std::size_t c = 0; c < prepared.set.curves.size(); ++c) {
    const FamilyMember& member = prepared.family.curves.members[c];
    FamilyCurve row = DescribeCurve(prepared.set.curves[c]);
    row.role = member.role;
    row.reason = member.reason;
    row.short_circuit_current_A = member.short_circuit_current_A;
    if (member.role != CurveRole::kLeftOut) {
      row.irradiance_W_m2 = member.joint.irradiance_W_m2;
      row.temperature_C = member.joint.temperature_K - kZeroCelsius_K;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// Fills the differences of the individual fit from the shared parameters.
void FillExcess(const TranslatedDevice& shared, FamilyCurve* row) {
  if (row->individual_parameters.size() != shared.parameters.size()) return;
  const KeyPoints model = ModelKeyPoints(shared.device, shared.parameters.data());
  const KeyPoints own = ModelKeyPoints(shared.device, row->individual_parameters.data());
  row->isc_excess = own.short_circuit_current_A / model.short_circuit_current_A - 1;
  row->voc_excess_V = own.open_circuit_voltage_V - model.open_circuit_voltage_V;
}

// Adds curve number `k` of a joint problem under the shared parameters `refined` to its row.
void AddJoint(const JointProblem& problem, const JointPoint& point, int k,
              const std::vector<double>& refined, const IvCurve& curve, FamilyCurve* row) {
  row->rmse = CurveRmse(problem, point, k);
  const TrueConditions at = ConditionsAt(problem, point, k);
  const TranslatedDevice device =
      TranslateTo(problem.translation, refined, at.irradiance_W_m2, at.temperature_K);
  row->parameters = device.parameters;
  std::vector<double> model;
  if (problem.translation.extended) {
    model = SolveCurrents(DeviceOf(problem, k), DeviceAt(problem, point, k).data(),
                          MakePointSet(curve.voltage_V, curve.current_A));
  } else {
    FillExcess(device, row);
    model = SolveCurrents(device.device, row->parameters.data(), curve.voltage_V);
  }
  double sum = 0;
  row->residual_A.reserve(model.size());
  for (std::size_t i = 0; i < model.size(); ++i) {
    row->residual_A.push_back(model[i] - curve.current_A[i]);
    sum += row->residual_A.back();
  }
  row->mean_residual_A = sum / static_cast<double>(model.size());
}

// The curves that do not belong to the device of the others, and the joint fit without them.
struct OutlierFit {
  std::vector<int> curves;                          // positions in the set
  std::optional<WithoutOutliers> without_outliers;  // none: no such curve
  bool stopped = false;
};

OutlierFit FitWithoutOutliers(const RefinedFamily& refined, const CurveSet& set,
                              const Observer& observer) {
  const FamilyProblem& family = refined.family;
  OutlierFit found;
  // The test frees the irradiance and temperature of a curve, which a curve with effects does not
  // have as unknowns.
  if (family.translation.extended) return found;
  const ProgressReporter progress(observer, "outlier curves", 0);
  const std::vector<int> outliers =
      FindOutlierCurves(refined.problem, refined.end, progress.stop());
  found.stopped = progress.Stopped();
  if (outliers.empty() || found.stopped) return found;
  JointProblem rest = refined.problem;
  JointPoint start = refined.end.point;
  for (auto c = outliers.rbegin(); c != outliers.rend(); ++c) {
    rest.curves.erase(rest.curves.begin() + *c);
    start.local.erase(start.local.begin() + *c);
  }
  JointOptions options;
  options.stop = progress.stop();
  const JointEnd refit = RefineJointly(rest, start, options);
  found.stopped = refit.stopped;
  if (found.stopped) return found;
  WithoutOutliers without;
  for (const int c : outliers) {
    found.curves.push_back(family.curves.fitted[c]);
    without.ids.push_back(set.curves[found.curves.back()].name);
  }
  const std::vector<double>& shared = refit.point.shared;
  without.rmse = FamilyRmse(rest, refit.point);
  without.shared.assign(shared.begin(), shared.begin() + family.translation.size());
  found.without_outliers = std::move(without);
  return found;
}

// The part of the report that is known before the search.
FamilyReport Header(const PreparedFamily& prepared) {
  const CurveSet& set = prepared.set;
  const FamilyOptions& options = prepared.options;
  const Translation& at = prepared.family.translation;
  FamilyReport report;
  report.version = Version();
  report.name = set.name;
  report.source = set.source;
  report.translation = at;
  report.objective = options.objective;
  report.cells_in_series = at.spec.cells_in_series;
  report.rejected = set.rejected;
  report.assumptions = SentencesOf(set.assumptions);
  report.assumptions.insert(report.assumptions.end(), prepared.family.notes.begin(),
                            prepared.family.notes.end());
  report.search_options = options.search;
  report.non_default_options = NonDefaults(options, kFamilyOptionTable);
  report.with = options.with;
  if (at.extended) report.taken = at.extended->effects->set;
  report.termination = "not run";
  report.curves = DescribeCurves(prepared);
  return report;
}

void AddSearch(const PreparedFamily& prepared, const FamilySearchEnd& searched,
               FamilyReport* report) {
  report->search = searched.summary;
  for (const int c : prepared.search_curves) {
    report->search_ids.push_back(prepared.set.curves[c].name);
  }
  const JointProblem problem =
      JointProblemOn(prepared.family, prepared.options, prepared.search_curves);
  report->rmse.searched = FamilyRmse(problem, searched.elites[0]);
  if (searched.has_random) report->rmse.random_baseline = FamilyRmse(problem, searched.random);
  const std::vector<double>& shared = searched.elites[0].shared;
  report->searched.assign(shared.begin(), shared.begin() + prepared.family.translation.size());
}

void AddIndividualFits(const CurvesAlone& alone, FamilyReport* report) {
  report->individual_seconds = alone.fits.seconds;
  for (std::size_t k = 0; k < alone.curves.size(); ++k) {
    const std::optional<Expected<FitReport>>& one = alone.fits.reports[k];
    if (one && *one) FillIndividualFit(**one, &report->curves[alone.curves[k]]);
  }
}

// Adds the best candidate polished alone.
void AddCandidate(const RefinedFamily& refined, FamilyReport* report) {
  const CandidateEnds& ends = *refined.candidate;
  const Translation& at = refined.family.translation;
  report->rmse.plain_polished = FamilyRmse(refined.problem, ends.plain.point);
  report->rmse.refined_best_candidate = FamilyRmse(refined.problem, ends.own.point);
  report->refined_best_candidate = ReportedShared(at, ends.own.point.shared);
  report->refined_best_candidate.resize(at.size());
  report->plain_seconds = ends.plain_seconds;
  report->best_candidate_seconds = ends.own_seconds;
}

void AddCurves(const PreparedFamily& prepared, const RefinedFamily& refined, FamilyReport* report) {
  const FamilyMembers& members = refined.family.curves;
  const auto add = [&](const JointProblem& problem, const JointPoint& point,
                       const std::vector<int>& curves) {
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const int c = curves[k];
      AddJoint(problem, point, static_cast<int>(k), report->refined, prepared.set.curves[c],
               &report->curves[c]);
    }
  };
  add(refined.problem, refined.end.point, members.fitted);
  if (members.held_out.empty()) return;
  add(JointProblemOn(refined.family, prepared.options, members.held_out),
      {refined.end.point.shared, std::vector<JointLocal>(members.held_out.size(), {0, 0})},
      members.held_out);
}

// Adds the joint fit with its intervals and tests. Returns whether the observer stopped it.
bool AddJointFit(const PreparedFamily& prepared, const RefinedFamily& refined,
                 const Observer& observer, FamilyReport* report) {
  const FamilyOptions& options = prepared.options;
  const FamilyMembers& members = refined.family.curves;
  const JointEnd& end = refined.end;
  if (refined.candidate) AddCandidate(refined, report);
  report->rmse.searched_all = refined.searched;
  report->rmse.refined = FamilyRmse(refined.problem, end.point);
  report->weights = refined.weights.used;
  report->weights_gain = refined.weights.gain;
  report->joint_seconds = refined.seconds;
  report->termination = end.stopped     ? "interrupted"
                        : end.converged ? "converged"
                                        : "no convergence";
  report->projected_gradient = end.projected_gradient;

  const ReportedFit reported(refined.family, refined.problem, end);
  const ProgressReporter progress(observer, 0);
  const JudgedEnd judged = JudgeFamily(reported, options, report->searched, progress);
  bool stopped = progress.Stopped();
  static_cast<JudgedFamily&>(*report) = judged;
  for (std::size_t k = 0; k < judged.offsets.size(); ++k) {
    FamilyCurve& row = report->curves[members.fitted[k]];
    row.irradiance_offset_W_m2 = judged.offsets[k].irradiance_W_m2;
    row.temperature_offset_K = judged.offsets[k].temperature_K;
  }
  if (options.intervals && !stopped) {
    static_cast<FamilyErrorIntervals&>(*report) = FindFamilyIntervals(
        reported, JointProblemOn(refined.family, options, members.held_out), judged);
  }
  AddCurves(prepared, refined, report);
  const std::optional<CandidateEnds>& candidate = refined.candidate;
  stopped =
      stopped || end.stopped || (candidate && (candidate->plain.stopped || candidate->own.stopped));
  if (stopped) return true;

  std::optional<FamilyTests> tests = TestFamily(prepared, refined, report->curves, observer);
  if (!tests) return true;
  static_cast<FamilyTests&>(*report) = std::move(*tests);
  OutlierFit outliers = FitWithoutOutliers(refined, prepared.set, observer);
  if (outliers.stopped) return true;
  for (const int c : outliers.curves) report->curves[c].outlier = true;
  report->without_outliers = std::move(outliers.without_outliers);
  const std::size_t curves = refined.problem.curves.size();
  if (!options.intervals || curves <= 2 || curves > kMostJackknifed) return false;
  auto jackknife = Jackknife(reported, report->estimates, options.threads, observer);
  if (jackknife) report->jackknife = std::move(*jackknife);
  return !jackknife;
}

}  // namespace

Expected<Translation> CheckFamily(const CurveSet& set, const FamilyOptions& options) {
  TRY(PreparedFamily prepared, PrepareFamily(set, options));
  return std::move(prepared.family.translation);
}

Expected<FamilyReport> FitFamily(const CurveSet& set, const FamilyOptions& options,
                                 const Observer& observer) {
  const Instant begin = Now();
  TRY(const PreparedFamily prepared, PrepareFamily(set, options));
  TRY(const FamilySearchEnd searched,
      SearchFamily(prepared.family, options, prepared.search_curves, observer));
  FamilyReport report = Header(prepared);
  AddSearch(prepared, searched, &report);
  report.interrupted = searched.summary.termination == SearchTermination::kInterrupted;
  CurvesAlone alone;
  if (!report.interrupted) {
    alone = FitCurvesAlone(prepared, observer);
    AddIndividualFits(alone, &report);
    report.interrupted = alone.fits.interrupted;
  }
  if (report.interrupted) {
    report.refined = report.searched;
  } else {
    const RefinedFamily refined = RefineFamily(prepared, searched, alone.starts, observer);
    report.interrupted = AddJointFit(prepared, refined, observer, &report);
  }
  report.doubts = DoubtsOfKept(set, report);
  report.warnings = report.doubts;
  const std::vector<std::string> found = FamilyWarnings(report, options);
  report.warnings.insert(report.warnings.end(), found.begin(), found.end());
  const double isc = prepared.family.curves.reference_current_A;
  const double solved = report.rmse.refined.solved_current_A;
  report.usable = std::isfinite(solved) && solved < 0.2 * isc;
  report.seconds = SecondsSince(begin);
  return report;
}

}  // namespace lyrefit
