#pragma once

#include <cmath>

#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {

// A report written by hand: a cell similar to RTC France, single diode, every section filled.
inline FitReport SampleReport() {
  FitReport report;
  report.version = "1.2.3";
  report.curve.name = "sample_cell";
  report.curve.source = "data/sample_cell.csv";
  report.curve.conditions.cell_temperature_K = 33 + kZeroCelsius_K;
  report.curve.assumptions = {"irradiance not given: assumed 1000 W/m2"};
  report.device = MakeDevice(report.model, report.curve.conditions);
  report.bounds_name = "physical";
  report.refined = {0.76078796653915, 3.1068454826343e-07, 1.47726777077893, 0.03654694602088,
                    52.88978737881768};
  report.searched = {0.7608, 3.2e-07, 1.48, 0.0363, 53.7};
  report.refined_best_candidate = report.refined;
  report.polished = true;
  for (int i = 0; i < 26; ++i) report.curve.voltage_V.push_back(-0.2 + 0.79 * i / 25);
  report.model_current_A =
      SolveCurrents(report.device, report.refined.data(), report.curve.voltage_V);
  for (int i = 0; i < 26; ++i) {
    report.residual_A.push_back(7e-4 * std::sin(2.1 * i * i));
    report.curve.current_A.push_back(report.model_current_A[i] - report.residual_A[i]);
  }
  for (int i = 0; i < report.device.size(); ++i) {
    Estimate e;
    e.info = report.device.parameters[i];
    e.bounds = {0, 100, 0, 100, SearchScale::kLinear};
    e.searched = report.searched[i];
    e.refined = report.refined[i];
    e.standard_error = 0.0123 * e.refined;
    e.low_95 = 0.975 * e.refined;
    e.high_95 = 1.025 * e.refined;
    e.interval = IntervalMethod::kSymmetric;
    report.estimates.push_back(e);
  }
  report.nNsVth = report.refined[2] * report.device.module_thermal_voltage_V;
  report.rmse.searched = {9.871e-4, 7.76e-4};
  report.rmse.random_baseline = {3.1e-2, 2.9e-2};
  report.rmse.refined_best_candidate = {9.891e-4, 7.731e-4};
  report.rmse.refined = {9.8912345678e-4, 7.7300626899e-4};
  report.measured = {0.7605, 0.5727, 0.4507, 0.6894, 0.31072, 0.7134};
  report.simulated = {0.7603, 0.5728, 0.4501, 0.6902, 0.31066, 0.7133};
  report.criteria = {26, 5, -358.5, -352.1};
  report.residuals = {1.41e-3, 0.5833, 1e-7, 12, 13.9, 0.42, 1.61};
  report.correlations = {{"Is1", "n1", 0.99987}, {"Iph", "Rsh", -0.912}};
  report.search.termination = SearchTermination::kIterations;
  report.search.iterations = 40;
  report.search.evaluations = 1200;
  report.curve_evaluations = 1200;
  report.search.seconds = 0.0041;
  report.search.elites.resize(4);
  report.refine.termination = "converged";
  report.refine.starts = {{"best candidate", 7.76e-4, 7.731e-4, false},
                          {"elite 2", 8.1e-4, 7.7300626899e-4, true},
                          {"grid n = 1.25; Rs = 0.036 ohm", 9e-4, 7.7300626899e-4, true}};
  report.refine.winner = 1;
  report.refine.agreeing = 2;
  report.refine.projected_gradient = 3.2e-11;
  report.refine.condition = 812;
  report.refine.seconds = 0.0023;
  report.interval_seconds = 0.0011;
  report.non_default_options = {{"seed", "7", "0"}};
  report.search_options.seed = 7;
  report.search_options.population = 30;
  report.search_options.iterations = 40;
  return report;
}

}  // namespace lyrefit
