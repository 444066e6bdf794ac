// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/devices/two_junction_options.h"
#include "lyrefit/estimate/fit/estimate_report.h"
#include "lyrefit/estimate/fit/fit_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// One curve of a fit of two junctions.
struct TwoJunctionCurveReport {
  IvCurve curve;
  StatedLight light;                           // as used; NaN: unknown
  std::array<double, 2> light_error = {0, 0};  // of uncertain lights, relative
  std::vector<double> parameters;  // of the device in this light, order of TwoJunctionInfos
  int limiting = 0;                // 1 or 2: the junction of lower photocurrent
  double rmse_A = kUnknown;        // solved-current
  std::vector<double> model_A;     // solved current at the readings
  KeyPoints measured;              // of the readings
  KeyPoints simulated;             // of the model
};

// Test of a fit of two junctions: its residuals against the noise that differences of neighbouring
// readings show. NaN: not tested.
struct JunctionTest {
  double noise_A = kUnknown;
  double rmse_over_noise = kUnknown;  // by degrees of freedom; 1: the device explains the curves
  double p_value = kUnknown;          // of so much by noise alone (F-test)
};

// Curves whose stated lights fit far better when exchanged.
struct ExchangedLights {
  std::string first;         // id of a curve
  std::string second;        // id of the other one
  double rmse_A = kUnknown;  // with exchanged lights
};

// Report of FitTwoJunctions(). The objective is the solved current; there is no explicit right-hand
// side for the measured one. Estimates: shared parameters, then photocurrents of single curves.
struct TwoJunctionReport : EstimateReport {
  std::string name;  // of the set
  ConstantSet constants = ConstantSet::kCodata;
  double temperature_K = kUnknown;  // of all curves
  // Nothing but their order tells the junctions apart: junction 1 is the one with the lower
  // photocurrent, and `estimates` has the excess of the other one's in place of Iph2.
  bool interchangeable = false;
  std::vector<TwoJunctionCurveReport> curves;
  JunctionTest test;                 // at exact lights
  JunctionTest test_of_rest;         // with uncertain lights; NaN: they are exact
  double exact_lights_p = kUnknown;  // p-value of exact lights against ones that err; NaN: none may
  double light_part = 0;             // standard deviation of the stated lights; 0: exact
  std::optional<ExchangedLights> exchanged;
  // Which measurement would decide the parameters that are not identifiable; empty: all are.
  std::vector<std::string> decided_by;
};

// Fits a device of two junctions in series (model/two_junctions.h) to one curve or to several under
// different lights of its junctions: Is, n and Rsh of each junction, one Rs, and the photocurrents.
// A curve whose light of a junction is stated (TwoJunctionOptions::lights, DeviceNotes::light_top
// and light_bottom) has that share of the common photocurrent; otherwise its photocurrent is an
// unknown of this curve. If no curve states a light, the first is the reference.
//
// MLO searches the bounds; its elites and starts from the shape of the curves are refined by
// bounded least squares of the solved currents with exact derivatives. Intervals are profiles where
// the problem is not linear enough. A parameter that the data do not limit on both sides is not
// identifiable, and the report names the measurement that would decide.
//
// Where the curves miss each other by more than noise, or the options state how well lights are known,
// each stated light but 1:1 has an error of its own as an unknown. Lights of two curves that fit far
// better when exchanged make the fit not usable.
//
// Errors: no curve, a dark or invalid curve, temperatures that differ by more than 1 K, unknown
// names, a light that is not positive, ranges out of order, too few readings.
Expected<TwoJunctionReport> FitTwoJunctions(const CurveSet& set,
                                            const TwoJunctionOptions& options = {},
                                            const Observer& observer = {});

// The curves of several measurements as one set for FitTwoJunctions(). Error: two curves of one
// name.
Expected<CurveSet> GatherCurves(std::vector<CurveSet> sets);

// `options` with bounds, fixed values, constants, search, intervals and threads of a fit.
TwoJunctionOptions WithOptionsOf(const FitOptions& fit, TwoJunctionOptions options);

}  // namespace lyrefit
