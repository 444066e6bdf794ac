#include "lyrefit/family/fit_family.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "lyrefit/base/seconds.h"
#include "lyrefit/base/try.h"
#include "lyrefit/base/version.h"
#include "lyrefit/family/family_errors.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/joint.h"
#include "lyrefit/family/key_point_errors.h"
#include "lyrefit/family/refine_family.h"
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

// The differences of the individual fit from the shared parameters.
struct Excess {
  double isc = kUnknown;
  double voc_V = kUnknown;
};
Excess ExcessOf(const TranslatedDevice& shared, const std::vector<double>& individual) {
  if (individual.size() != shared.parameters.size()) return {};
  const KeyPoints model = ModelKeyPoints(shared.device, shared.parameters.data());
  const KeyPoints own = ModelKeyPoints(shared.device, individual.data());
  return {own.short_circuit_current_A / model.short_circuit_current_A - 1,
          own.open_circuit_voltage_V - model.open_circuit_voltage_V};
}

// The row of curve number `k` of a joint problem, with the results under the shared parameters
// `refined`.
FamilyCurve WithJointFit(FamilyCurve row, const JointProblem& problem, const JointPoint& point,
                         int k, const std::vector<double>& refined, const IvCurve& curve) {
  row.rmse = CurveRmse(problem, point, k);
  const TrueConditions at = ConditionsAt(problem, point, k);
  const TranslatedDevice device =
      TranslateTo(problem.translation, refined, at.irradiance_W_m2, at.temperature_K);
  row.parameters = device.parameters;
  std::vector<double> model;
  if (problem.translation.extended) {
    model = SolveCurrents(DeviceOf(problem, k), DeviceAt(problem, point, k).data(),
                          MakePointSet(curve.voltage_V, curve.current_A));
  } else {
    const Excess excess = ExcessOf(device, row.individual_parameters);
    row.isc_excess = excess.isc;
    row.voc_excess_V = excess.voc_V;
    model = SolveCurrents(device.device, row.parameters.data(), curve.voltage_V);
  }
  double sum = 0;
  row.residual_A.reserve(model.size());
  for (std::size_t i = 0; i < model.size(); ++i) {
    row.residual_A.push_back(model[i] - curve.current_A[i]);
    sum += row.residual_A.back();
  }
  row.mean_residual_A = sum / static_cast<double>(model.size());
  return row;
}

// The curves that do not belong to the device of the others, and the joint fit without them.
struct OutlierFit {
  std::vector<int> curves;                          // positions in the set
  std::optional<WithoutOutliers> without_outliers;  // none: no such curve
  bool stopped = false;
};

// As FitWithoutOutliers, of key points.
OutlierFit FitWithoutWrongCells(const RefinedFamily& refined, const CurveSet& set,
                                const ProgressReporter& progress) {
  constexpr struct {
    const char* point;
    const char* unit;
  } kNames[kKeyPointRows] = {{"Isc", "A"}, {"Voc", "V"}, {"Vmp", "V"}, {"Imp", "A"}};
  const FamilyProblem& family = refined.family;
  const WithoutWrongCells found =
      FindWrongCells(refined.problem, refined.end, family.free_parameters, progress.stop());
  OutlierFit fit;
  fit.stopped = progress.Stopped();
  if (found.cells.empty() || fit.stopped) return fit;
  WithoutOutliers without;
  for (const WrongCell& cell : found.cells) {
    const int curve = family.curves.fitted[cell.curve];
    const std::string& id = set.curves[curve].name;
    const bool new_one = std::count(fit.curves.begin(), fit.curves.end(), curve) == 0;
    if (new_one) fit.curves.push_back(curve);
    if (new_one) without.ids.push_back(id);
    without.cells.push_back(
        {id, kNames[cell.point].point, kNames[cell.point].unit, cell.measured, cell.expected});
  }
  without.rmse = FamilyRmse(refined.problem, found.end.point);
  const std::vector<double>& shared = found.end.point.shared;
  without.shared.assign(shared.begin(), shared.begin() + family.translation.size());
  fit.without_outliers = std::move(without);
  return fit;
}

OutlierFit FitWithoutOutliers(const RefinedFamily& refined, const CurveSet& set,
                              const Observer& observer) {
  const FamilyProblem& family = refined.family;
  OutlierFit found;
  // The test frees the irradiance and temperature of a curve, which a curve with effects does not
  // have as unknowns.
  if (family.translation.extended) return found;
  const ProgressReporter progress(observer, "outlier curves", 0);
  if (family.curves.key_points) return FitWithoutWrongCells(refined, set, progress);
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

// The part of the report that is known after the search and the individual fits.
FamilyReport SearchReport(const PreparedFamily& prepared, const FamilySearchEnd& searched,
                          const CurvesAlone& alone) {
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
  report.search = searched.summary;
  report.curve_evaluations = searched.summary.evaluations;
  for (const int c : prepared.search_curves) report.search_ids.push_back(set.curves[c].name);
  const JointProblem problem = JointProblemOn(prepared.family, options, prepared.search_curves);
  report.rmse.searched = FamilyRmse(problem, searched.elites[0]);
  if (searched.has_random) report.rmse.random_baseline = FamilyRmse(problem, searched.random);
  const std::vector<double>& shared = searched.elites[0].shared;
  report.searched.assign(shared.begin(), shared.begin() + at.size());
  report.curves = DescribeCurves(prepared);
  report.individual_seconds = alone.fits.seconds;
  for (std::size_t k = 0; k < alone.curves.size(); ++k) {
    const std::optional<Expected<FitReport>>& one = alone.fits.reports[k];
    if (one && *one) FillIndividualFit(**one, &report.curves[alone.curves[k]]);
  }
  return report;
}

// Last stage of a family fit: what follows from the end of the joint fit. After a request to stop
// the later members are missing.
struct JudgedJointFit {
  JudgedEnd end;
  FamilyErrorIntervals error_intervals;
  std::vector<FamilyCurve> curves;  // of the set
  FamilyTests tests;
  std::optional<WithoutOutliers> without_outliers;
  std::vector<Interval> jackknife;  // empty: not computed
  std::optional<KeyPointSummary> key_points;
  std::optional<EqualDevices> equal_devices;
  bool stopped = false;
};

// The rows of the curves with the joint fit's results.
std::vector<FamilyCurve> WithJointFit(std::vector<FamilyCurve> rows, const PreparedFamily& prepared,
                                      const RefinedFamily& refined, const JudgedEnd& judged) {
  const FamilyMembers& members = refined.family.curves;
  const auto add = [&](const JointProblem& problem, const JointPoint& point,
                       const std::vector<int>& curves) {
    for (std::size_t k = 0; k < curves.size(); ++k) {
      const int c = curves[k];
      rows[c] = WithJointFit(std::move(rows[c]), problem, point, static_cast<int>(k),
                             judged.refined, prepared.set.curves[c]);
    }
  };
  for (std::size_t k = 0; k < judged.offsets.size(); ++k) {
    FamilyCurve& row = rows[members.fitted[k]];
    row.irradiance_offset_W_m2 = judged.offsets[k].irradiance_W_m2;
    row.temperature_offset_K = judged.offsets[k].temperature_K;
  }
  add(refined.problem, refined.end.point, members.fitted);
  if (members.held_out.empty()) return rows;
  add(JointProblemOn(refined.family, prepared.options, members.held_out),
      {refined.end.point.shared, std::vector<JointLocal>(members.held_out.size(), {0, 0})},
      members.held_out);
  return rows;
}

// `rows`: the curves with their individual fits; `searched`: shared parameters of the search.
JudgedJointFit JudgeJointFit(const PreparedFamily& prepared, const RefinedFamily& refined,
                             std::vector<FamilyCurve> rows, const std::vector<double>& searched,
                             const Observer& observer) {
  const FamilyOptions& options = prepared.options;
  const ReportedFit reported(refined.family, refined.problem, refined.end);
  const ProgressReporter progress(observer, 0);
  JudgedJointFit judged;
  judged.end = JudgeFamily(reported, options, searched, progress);
  judged.stopped = progress.Stopped();
  if (options.intervals && !judged.stopped && !refined.family.curves.key_points) {
    judged.error_intervals = FindFamilyIntervals(
        reported, JointProblemOn(refined.family, options, refined.family.curves.held_out),
        judged.end);
  }
  judged.curves = WithJointFit(std::move(rows), prepared, refined, judged.end);
  const std::optional<CandidateEnds>& candidate = refined.candidate;
  judged.stopped = judged.stopped || refined.end.stopped ||
                   (candidate && (candidate->plain.stopped || candidate->own.stopped));
  if (judged.stopped) return judged;

  judged.stopped = true;  // unless all that follows is done
  std::optional<FamilyTests> tests = TestFamily(prepared, refined, judged.curves, observer);
  if (!tests) return judged;
  judged.tests = std::move(*tests);
  if (refined.family.curves.key_points) {
    judged.curves =
        WithKeyPoints(std::move(judged.curves), refined, judged.end.refined, judged.tests);
    judged.key_points = SummariseKeyPoints(judged.curves, refined, options, judged.end);
    if (options.intervals) {
      judged.equal_devices = FindEqualDevices(refined, judged.end.estimate.estimates, observer);
    }
  }
  OutlierFit outliers = FitWithoutOutliers(refined, prepared.set, observer);
  if (outliers.stopped) return judged;
  for (const int c : outliers.curves) judged.curves[c].outlier = true;
  judged.without_outliers = std::move(outliers.without_outliers);
  const std::size_t curves = refined.problem.curves.size();
  if (options.intervals && curves > 2 && curves <= kMostJackknifed) {
    auto jackknife = Jackknife(reported, judged.end.estimate.estimates, options.threads, observer);
    if (!jackknife) return judged;
    judged.jackknife = std::move(*jackknife);
  }
  judged.stopped = false;
  return judged;
}

// The report with the joint fit.
FamilyReport WithJointFit(FamilyReport report, const RefinedFamily& refined,
                          JudgedJointFit judged) {
  const Translation& at = refined.family.translation;
  const JointEnd& end = refined.end;
  if (refined.candidate) {
    report.rmse.plain_polished = FamilyRmse(refined.problem, refined.candidate->plain.point);
    report.rmse.refined_best_candidate = FamilyRmse(refined.problem, refined.candidate->own.point);
    report.refined_best_candidate = ReportedShared(at, refined.candidate->own.point.shared);
    report.refined_best_candidate.resize(at.size());
    report.plain_seconds = refined.candidate->plain_seconds;
    report.refine.best_candidate_seconds = refined.candidate->own_seconds;
  }
  report.weights = refined.weights.used;
  report.weights_gain = refined.weights.gain;
  report.searched_all = refined.searched;
  if (refined.family.curves.key_points) {
    report.searched_key_points = refined.searched_key_points;
    report.refined_key_points = KeyPointRms(refined.problem, end.point);
  }
  report.rmse.refined = FamilyRmse(refined.problem, end.point);
  report.refine.seconds = refined.seconds;
  report.refine.termination = end.stopped     ? "interrupted"
                              : end.converged ? "converged"
                                              : "no convergence";
  report.refine.projected_gradient = end.projected_gradient;
  report.refine.condition = judged.end.estimate.refine.condition;
  report.interval_seconds = judged.end.estimate.interval_seconds;
  report.estimates = std::move(judged.end.estimate.estimates);
  report.correlations = std::move(judged.end.estimate.correlations);
  static_cast<JudgedFamily&>(report) = std::move(judged.end);
  static_cast<FamilyErrorIntervals&>(report) = std::move(judged.error_intervals);
  static_cast<FamilyTests&>(report) = std::move(judged.tests);
  report.curves = std::move(judged.curves);
  report.without_outliers = std::move(judged.without_outliers);
  report.jackknife = std::move(judged.jackknife);
  report.key_points = judged.key_points;
  report.equal_devices = std::move(judged.equal_devices);
  report.interrupted = judged.stopped;
  return report;
}

// Whether the fit misses less than a fifth of Isc, or of Pmp for key points.
bool IsUsable(const FamilyReport& report, double isc_A) {
  constexpr double kMost = 0.2;
  if (report.key_points) return report.key_points->max_power_of_reference < kMost;
  const double solved = report.rmse.refined.solved_current_A;
  return std::isfinite(solved) && solved < kMost * isc_A;
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
  const bool interrupted = searched.summary.termination == SearchTermination::kInterrupted;
  const CurvesAlone alone = interrupted ? CurvesAlone() : FitCurvesAlone(prepared, observer);
  FamilyReport report = SearchReport(prepared, searched, alone);
  report.interrupted = interrupted || alone.fits.interrupted;
  if (report.interrupted) {
    report.refined = report.searched;
  } else {
    const RefinedFamily refined = RefineFamily(prepared, searched, alone.starts, observer);
    JudgedJointFit judged =
        JudgeJointFit(prepared, refined, report.curves, report.searched, observer);
    report = WithJointFit(std::move(report), refined, std::move(judged));
  }
  report.doubts = DoubtsOfKept(set, report);
  report.warnings = report.doubts;
  const std::vector<std::string> found = FamilyWarnings(report, options);
  report.warnings.insert(report.warnings.end(), found.begin(), found.end());
  report.usable = IsUsable(report, prepared.family.curves.reference_current_A);
  report.seconds = SecondsSince(begin);
  return report;
}

}  // namespace lyrefit
