// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
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
  StatedLight light;               // as used; NaN: unknown
  std::vector<double> parameters;  // of the device in this light, order of TwoJunctionInfos
  int limiting = 0;                // 1 or 2: the junction of lower photocurrent
  double rmse_A = kUnknown;        // solved-current
  std::vector<double> model_A;     // solved current at the readings
  KeyPoints measured;              // of the readings
  KeyPoints simulated;             // of the model
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
