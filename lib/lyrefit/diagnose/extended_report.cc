
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "lyrefit/base/append.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/version.h"
#include "lyrefit/diagnose/describe.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/intervals.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/make_readings.h"
#include "lyrefit/model/reporting_units.h"
#include "lyrefit/search/search.h"

namespace lyrefit {
namespace {

// Global search for the parameters of the extended law, with the fit's default optimizer.
// Parameters that are selected on a grid stay at the values of the selection.
struct LawSearch {
  RmseTable rmse;
  SearchOptions options;
  SearchSummary summary;
  std::vector<double> best;  // parameters of the law
};

// Box of the search for the coordinates, with ranges that hold for all curves.
Box SearchBox(const Selection& selection, const LawCoordinates& coordinates) {
  const Law& law = selection.extended.law;
  const std::vector<double> theta = coordinates.Of(selection.extended.p);
  const double iph = coordinates.Of(selection.base.p)[kIph];
  Box box;
  box.lower = {0.8 * iph, -3, 0.5, 0, 0};
  box.upper = {1.2 * iph, 2, 3, 0.3, 1};
  if (law.model == Model::kDoubleDiode) {
    box.lower.push_back(0);
    box.upper.push_back(1);
  }
  const LeastSquaresProblem problem = coordinates.Problem();
  for (int k = static_cast<int>(box.lower.size()); k < law.size(); ++k) {
    const bool fixed = problem.fixed[k] != 0;
    box.lower.push_back(fixed ? theta[k] : problem.lower[k]);
    box.upper.push_back(fixed ? theta[k] + 1e-12 : problem.upper[k]);
  }
  return box;
}

LawSearch SearchLaw(const Selection& selection, std::uint64_t seed, const Observer& observer) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const Law& law = selection.extended.law;
  std::vector<double> current(readings.points.size());
  // The workspace starts afresh each time: the value must not depend on the previous candidate.
  const std::vector<ReadingBlock> blocks = BlocksOf(readings);
  LawWorkspace workspace(blocks);
  const LawCoordinates coordinates(law, readings);
  const auto rmse = [&](const double* theta) {
    if (!coordinates.Evaluate(theta, &workspace, current.data(), nullptr)) return kInfinity;
    return RmseOf(weighted, current);
  };
  LawSearch searched;
  searched.options.seed = seed;
  searched.options.population = 40;
  searched.options.iterations = 100;
  const Box box = SearchBox(selection, coordinates);
  searched.summary = Search(rmse, box, searched.options, observer);
  searched.best = coordinates.Parameters(searched.summary.best.x);
  searched.rmse.searched.solved_current_A = searched.summary.best.objective;
  SearchOptions random = searched.options;
  random.algorithm = Algorithm::kRandom;
  searched.rmse.random_baseline.solved_current_A =
      Search(rmse, box, random, observer).best.objective;
  const LawFit polished = FitLaw(weighted, law, searched.best);
  if (polished.usable) {
    searched.rmse.refined_best_candidate.solved_current_A = RmseOf(weighted, polished.current);
  }
  return searched;
}

// Values in reporting units, in the order of the report.
std::vector<double> Reported(const WeightedData& weighted, const Law& law,
                             const std::vector<double>& p) {
  const Readings& readings = *weighted.readings;
  std::vector<double> values = p;
  if (readings.traits.single && !readings.traits.only_dark) {
    values[kIph] *= readings.points.front().irradiance;
  }
  for (std::size_t e = 0; e < law.effects.size(); ++e) {
    const int first = law.Offset(static_cast<int>(e));
    for (int k = 0; k < law.effects[e]->size(); ++k) {
      values[first + k] *=
          law.effects[e]->parameters[k].ReportedFactor(p.data() + first, readings.scale);
    }
  }
  return values;
}

Estimate WithInterval(Estimate estimate, double error, double t) {
  if (!(error > 0 && std::isfinite(error))) return estimate;
  const bool positive = estimate.info.symbol != "alpha";
  const ParameterRange range = SymmetricRange(ParameterKind::kPlain, estimate.refined, error, t,
                                              {positive ? 0 : -kInfinity, kInfinity});
  estimate.standard_error = error;
  estimate.low_95 = range.low;
  estimate.high_95 = range.high;
  estimate.interval = IntervalMethod::kSymmetric;
  return estimate;
}

// Intervals and bounds of effect `e` of the law, without its values.
std::vector<Estimate> EstimatesOfEffect(const Selection& selection, int e) {
  const LawFit& fit = selection.extended;
  const Effect& effect = *fit.law.effects[e];
  std::vector<Estimate> estimates(effect.size());
  const auto described = DescribeParameters(selection.weighted, fit, e);
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& info = effect.parameters[k];
    Estimate& estimate = estimates[k];
    estimate.info = {std::string(effect.id) + "." + info.symbol,
                     std::string(effect.id) + "_" + info.name, info.unit, info.doc};
    for (const CauseParameter& parameter : described) {
      if (parameter.symbol != info.symbol) continue;
      estimate.low_95 = parameter.low_95;
      estimate.high_95 = parameter.high_95;
    }
    estimate.fixed = info.searched;
    if (std::isfinite(estimate.low_95)) estimate.interval = IntervalMethod::kSymmetric;
    const double factor =
        info.ReportedFactor(fit.p.data() + fit.law.Offset(e), selection.weighted.readings->scale);
    estimate.bounds.lower = std::min(info.lower * factor, info.upper * factor);
    estimate.bounds.upper = std::max(info.lower * factor, info.upper * factor);
  }
  return estimates;
}

// Those of the base, then those of each effect. `refined`, `searched`: values in this order; the
// latter may be empty.
std::vector<Estimate> EstimatesOf(const Selection& selection, const std::vector<double>& refined,
                                  const std::vector<double>& searched) {
  const Law& law = selection.extended.law;
  const std::vector<ParameterInfo> infos = law.BaseInfos();
  const std::vector<ParameterShift> shifts = DescribeShifts(selection);
  const double t = StudentT95(Degrees(selection.weighted, law));
  std::vector<Estimate> estimates(infos.size());
  for (std::size_t e = 0; e < law.effects.size(); ++e) {
    Append(EstimatesOfEffect(selection, static_cast<int>(e)), &estimates);
  }
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    estimates[k].refined = refined[k];
    if (!searched.empty()) estimates[k].searched = searched[k];
  }
  for (std::size_t k = 0; k < infos.size(); ++k) {
    estimates[k].info = {infos[k].symbol, infos[k].name, infos[k].unit, infos[k].doc};
    estimates[k].fixed = infos[k].symbol == "n2";
    for (const ParameterShift& shift : shifts) {
      if (shift.symbol != infos[k].symbol) continue;
      estimates[k] = WithInterval(std::move(estimates[k]), shift.standard_error, t);
    }
  }
  return estimates;
}

IvCurve AllPoints(const CurveSet& set) {
  IvCurve all = set.curves.front();
  if (set.curves.size() == 1) return all;
  all.name = set.name;
  for (std::size_t c = 1; c < set.curves.size(); ++c) {
    const IvCurve& curve = set.curves[c];
    all.voltage_V.insert(all.voltage_V.end(), curve.voltage_V.begin(), curve.voltage_V.end());
    all.current_A.insert(all.current_A.end(), curve.current_A.begin(), curve.current_A.end());
  }
  all.sigma_A.clear();
  all.time_s.clear();
  all.sweep.clear();
  all.irradiance_W_m2.clear();
  all.temperature_C.clear();
  return all;
}

// The report with alpha and the band gap if the law keeps them fixed.
FitReport WithFixed(FitReport report, const Selection& selection) {
  const Law& law = selection.extended.law;
  const Readings& readings = *selection.weighted.readings;
  const auto insert = [&](int at, ParameterInfo info, double value) {
    Estimate estimate;
    estimate.info = std::move(info);
    estimate.refined = estimate.searched = value;
    estimate.fixed = true;
    report.estimates.insert(report.estimates.begin() + at, estimate);
    report.refined.insert(report.refined.begin() + at, value);
    report.searched.insert(report.searched.begin() + at, value);
  };
  Law free = law;
  free.free_tempco = free.free_bandgap = true;
  const std::vector<ParameterInfo> infos = free.BaseInfos();
  if (!law.free_tempco) {
    insert(free.TempcoAt(), infos[free.TempcoAt()],
           readings.isc_tempco_per_K * selection.extended.p[kIph] +
               readings.isc_tempco_scales_per_K * readings.scale.current_A);
  }
  if (!law.free_bandgap) {
    insert(free.BandgapAt(), infos[free.BandgapAt()], readings.bandgap_eV);
  }
  return report;
}

// The curves with the irradiances that the law uses.
CurveSet AsRead(const CurveSet& set, const Readings& readings) {
  CurveSet read = set;
  for (const Reading& r : readings.points) {
    Conditions& at = read.curves[r.curve].conditions;
    if (r.index == 0 && read.curves[r.curve].irradiance_W_m2.empty()) {
      at.irradiance_W_m2 = 1000 * r.irradiance;
    }
    if (r.dark) at.irradiance_W_m2 = 0;
  }
  return read;
}

// Whether the law is one curve's base alone: no effects, no free alpha or band gap, constant
// conditions.
bool IsPlain(const CurveSet& set, const Law& law) {
  const IvCurve& curve = set.curves.front();
  return set.curves.size() == 1 && law.effects.empty() && !law.free_tempco && !law.free_bandgap &&
         curve.irradiance_W_m2.empty() && curve.temperature_C.empty();
}

// The report with the law as a device with effects, for simulation. Requirements: the number of cells
// as stated and, for one curve, effects and no free alpha or band gap. A plain law gets the device
// of its number of cells. The parameters are then in the device's internal units.
FitReport WithLaw(FitReport report, const CurveSet& set, const Selection& selection,
                  const Readings& readings) {
  const Law& law = selection.extended.law;
  const IvCurve& curve = set.curves.front();
  const bool one = set.curves.size() == 1;
  if (IsPlain(set, law)) {
    Conditions at = curve.conditions;
    at.cells_in_series = readings.scale.cells;
    report.device = MakeDevice(law.model, at);
    return report;
  }
  if (one && (law.effects.empty() || law.free_tempco || law.free_bandgap)) return report;
  if (readings.scale.cells != curve.conditions.cells_in_series) return report;
  std::vector<EffectUse> uses;
  for (const Effect* effect : law.effects) uses.push_back({effect, {}});
  Conditions reference = curve.conditions;
  if (!one) reference.cell_temperature_K = readings.reference_temperature_K;
  const Device base = MakeDevice(law.model, reference);
  auto device = one ? Extend(base, law.model, ConstantSet::kCodata, curve, uses, /*force=*/true)
                    : ExtendSet(base, law, AsRead(set, readings), readings.reference_temperature_K,
                                uses, /*force=*/true);
  if (!device) return report;
  if (!one) report = WithFixed(std::move(report), selection);
  report.device = std::move(*device);
  report.refined = Internal(report.device, report.refined);
  report.searched = Internal(report.device, report.searched);
  report.refined_best_candidate = report.refined;
  return report;
}

}  // namespace

FitReport ExtendedReport(const CurveSet& set, const Selection& selection, const AtReadings& at,
                         bool search, std::uint64_t seed, const Observer& observer) {
  const WeightedData& weighted = selection.weighted;
  const Readings& readings = *weighted.readings;
  const LawFit& fit = selection.extended;
  FitReport report;
  report.version = Version();
  report.model = fit.law.model;
  report.bounds_name = "catalogue of effects";
  report.usable = fit.usable;
  for (const Effect* effect : fit.law.effects) report.causes.push_back(effect->id);
  report.curves = static_cast<int>(set.curves.size());
  report.polished = true;
  if (!fit.usable) return report;
  std::vector<double> searched;
  if (search) {
    const LawSearch found = SearchLaw(selection, seed, observer);
    report.rmse = found.rmse;
    report.search_options = found.options;
    report.search = found.summary;
    report.interrupted = found.summary.termination == SearchTermination::kInterrupted;
    searched = Reported(weighted, fit.law, found.best);
  }
  report.refined = Reported(weighted, fit.law, fit.p);
  report.estimates = EstimatesOf(selection, report.refined, searched);
  report.searched = searched.empty() ? report.refined : searched;
  report.refined_best_candidate = report.refined;
  report.rmse.refined.solved_current_A = RmseOf(at.weighted, at.extended);
  report.nNsVth = Ideality(fit) * readings.traits.thermal_voltage * readings.scale.cells;
  if (!search) return report;
  report = WithLaw(std::move(report), set, selection, *at.weighted.readings);
  report.curve = AllPoints(set);
  report.refine.termination = "converged";
  for (std::size_t k = 0; k < at.extended.size(); ++k) {
    report.model_current_A.push_back(at.extended[k] * readings.scale.current_A);
    report.residual_A.push_back(report.model_current_A[k] - report.curve.current_A[k]);
  }
  report.measured = FindKeyPoints(report.curve.voltage_V, report.curve.current_A);
  report.simulated = FindKeyPoints(report.curve.voltage_V, report.model_current_A);
  report.residuals = FindResidualStatistics(report.curve.voltage_V, report.residual_A);
  const double rmse = report.rmse.refined.solved_current_A;
  report.criteria = FindInformation(rmse * rmse, at.weighted.count(), FreeCount(weighted, fit.law));
  report.warnings.push_back(
      "an extended model: its causes change currents as 'lyrefit diagnose --explain' says; the "
      "readings are weighted by their estimated noise");
  return report;
}

}  // namespace lyrefit
