#pragma once

#include <cmath>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// One parameter as a joint fit reports it.
inline Estimate SharedEstimate(const ParameterInfo& info, double value) {
  Estimate e;
  e.info = info;
  e.bounds = {0, 10 * value, 0, 10 * value, SearchScale::kLinear};
  e.searched = 1.01 * value;
  e.refined = value;
  e.standard_error = 0.001 * std::abs(value);
  e.low_95 = value - 0.002 * std::abs(value);
  e.high_95 = value + 0.002 * std::abs(value);
  e.interval = IntervalMethod::kSymmetric;
  return e;
}

// A module of 36 cells under `curves` irradiances, and its report, written by hand with every
// section filled. The first curve is held out, the second left out, the third an outlier.
struct SampleFamily {
  CurveSet set;
  FamilyReport report;
};

inline void AddSampleCurve(int index, int curves, SampleFamily* sample) {
  FamilyReport& report = sample->report;
  FamilyCurve curve;
  curve.id = "sweep-" + std::to_string(index);
  curve.irradiance_W_m2 = 100 + 900.0 * index / (curves - 1);
  curve.temperature_C = 15 + 10 * (index % 5);
  const TranslatedDevice at = TranslateTo(report.translation, report.refined, curve.irradiance_W_m2,
                                          curve.temperature_C + kZeroCelsius_K);
  IvCurve points;
  points.name = curve.id;
  points.conditions.cell_temperature_K = curve.temperature_C + kZeroCelsius_K;
  points.conditions.irradiance_W_m2 = curve.irradiance_W_m2;
  for (int i = 0; i < 25; ++i) points.voltage_V.push_back(21.0 * i / 24);
  points.current_A = SolveCurrents(at.device, at.parameters.data(), points.voltage_V);
  for (int i = 0; i < 25; ++i) {
    curve.residual_A.push_back(2e-3 * std::sin(2.1 * i * i + index));
    points.current_A[i] -= curve.residual_A[i];
  }
  curve.points = points.size();
  curve.parameters = at.parameters;
  curve.individual_parameters = at.parameters;
  curve.individual_parameters[kRs] *= 1.02;
  curve.short_circuit_current_A = points.current_A[0];
  curve.rmse = {1.5e-3 + 1e-5 * index, 1.4e-3 + 1e-5 * index};
  curve.individual_rmse = {1.3e-3, 1.2e-3};
  curve.isc_excess = 0.0123;
  curve.voc_excess_V = -0.045;
  curve.mean_residual_A = 1e-4 * std::cos(index);
  curve.irradiance_offset_W_m2 = {1.5, 0.2, 1.1, 1.9};
  sample->set.curves.push_back(points);
  report.curves.push_back(curve);
}

inline FamilyReport SampleFamilyHead() {
  FamilyReport report;
  report.version = "1.2.3";
  report.name = "sample_module";
  report.source = "data/sample_module";
  report.cells_in_series = 36;
  TranslationSpec spec;
  spec.cells_in_series = 36;
  report.translation = *MakeTranslation(spec);
  // Iph, Is1, n1, Rs, Rsh, alpha, Eg, dEg
  report.refined = {5.01, 1.1e-9, 1.05, 0.31, 210, 2.5e-3, 1.121, -0.0002677};
  for (int i = 0; i < report.translation.size(); ++i) {
    report.estimates.push_back(SharedEstimate(report.translation.parameters[i], report.refined[i]));
    report.searched.push_back(report.estimates.back().searched);
    const Estimate& e = report.estimates.back();
    report.jackknife.push_back({e.refined, kUnknown, 0.99 * e.refined, 1.01 * e.refined});
  }
  Estimate& held = report.estimates.back();
  held.fixed = true;
  held.standard_error = held.low_95 = held.high_95 = kUnknown;
  held.interval = IntervalMethod::kNone;
  report.jackknife.back() = {};
  report.estimates[4].at_bound = BoundSide::kUpper;
  report.estimates[6].identifiable = false;
  report.estimates[6].reason = "the temperatures span 2 K only";
  report.irradiance_offset_W_m2 = {-3.1, 0.4, -3.9, -2.3};
  report.coefficients = {{"alpha_sc", "A/K", {2.5e-3, 1e-5, 2.48e-3, 2.52e-3}},
                         {"gamma_pmp", "%/K", {-0.45, 0.01, -0.47, -0.43}}};
  report.reference = {5.0026, 21.9, 17.5, 4.7, 82.25, 0.7507};
  report.rmse.random_baseline = {3.1e-1, 2.9e-1};
  report.rmse.searched = {9.8e-3, 7.7e-3};
  report.searched_all = {9.9e-3, 7.8e-3};
  report.rmse.refined = {1.534e-3, 1.4321e-3};
  report.noise_A = 1.44e-3;
  report.search_ids = {"sweep-3", "sweep-5"};
  return report;
}

inline SampleFamily MakeSampleFamily(int curves) {
  SampleFamily sample;
  sample.report = SampleFamilyHead();
  FamilyReport& report = sample.report;
  for (int i = 0; i < curves; ++i) AddSampleCurve(i, curves, &sample);
  report.curves[0].role = CurveRole::kHeldOut;
  report.curves[1].role = CurveRole::kLeftOut;
  report.curves[1].reason = "taken in the dark";
  report.curves[1].irradiance_known = false;
  report.curves[2].outlier = true;
  report.held_out =
      HeldOut{"5 folds of whole curves", 5, {2e-3, 1.9e-3}, 1.8e-3, 2.5e-3, "sweep-0", {}, 1.2e-3};
  report.against = {
      {"sheet.json", "De Soto", {"", 5, {5e-3, 4.9e-3}, 4.8e-3, 6.5e-3, "sweep-3", {}, kUnknown}}};
  report.without_outliers = WithoutOutliers{{"sweep-2"}, {}, {1.1e-3, 1e-3}, report.refined};
  report.candidates = {
      {TranslationLaw::kDeSoto, Model::kSingleDiode, {2e-3, 1.9e-3}, 1.7e-3, 1.8e-3, 0, 7, true},
      {TranslationLaw::kPvsyst,
       Model::kDoubleDiode,
       {2.1e-3, 2e-3},
       1.9e-3,
       2.1e-3,
       2.5,
       9,
       false}};
  report.correlations = {{"Is1", "n1", 0.998}};
  report.search.iterations = 60;
  report.search.evaluations = 1830;
  report.curve_evaluations = 1830;
  report.search.termination = SearchTermination::kIterations;
  report.search.trace = {{0, 30, 0.2}, {60, 1830, 7.7e-3}};
  report.refine.termination = "converged";
  report.refine.projected_gradient = 1e-13;
  report.seconds = 1.5;
  report.individual_seconds = 0.4;
  report.rejected = {{"torn", Error{"expected a number, found 'abc'", "torn.csv", 7, 3}}};
  report.non_default_options = {{"folds", "3", "5"}};
  report.assumptions = {"cells in series not given: assumed 36"};
  report.warnings = {"sweep-2 looks like another device"};
  return sample;
}

// The sample curves with an individual fit of each.
inline SampleFamily MakeFreeSample(int curves) {
  SampleFamily sample = MakeSampleFamily(curves);
  FamilyReport& report = sample.report;
  report.estimates.clear();
  report.searched.clear();
  report.refined.clear();
  report.jackknife.clear();
  report.without_outliers.reset();
  report.held_out.reset();
  report.against.clear();
  report.candidates.clear();
  for (FamilyCurve& curve : report.curves) {
    curve.parameters.clear();
    curve.rmse = {};
    curve.irradiance_offset_W_m2 = {};
    curve.outlier = false;
  }
  return sample;
}

}  // namespace lyrefit
