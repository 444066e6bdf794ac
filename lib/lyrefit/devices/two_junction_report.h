// Experimental: may change in a minor version (data/stable).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/devices/two_junction_options.h"
#include "lyrefit/estimate/fit/estimate_report.h"

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

}  // namespace lyrefit
