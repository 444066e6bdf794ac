#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/estimate/refine/error_model.h"
#include "lyrefit/estimate/refine/intervals.h"
#include "lyrefit/estimate/refine/refine.h"

namespace lyrefit {

// The end of a fit of one curve, and the errors of its residuals.
struct CurveEnd {
  const RefineProblem& problem;
  const RefineEnd& end;
  int spare_readings = 1;  // distinct readings minus free parameters, at least 1
  // Errors of the residuals, in A, if they differ from those that the fit assumed. Each profile is
  // then extended by the ratio of the standard errors.
  const ErrorModel* errors = nullptr;
};

// Standard errors of all parameters, in reporting units; NaN where there is none.
std::vector<double> StandardErrors(const CurveEnd& fit);

struct CurveIntervalOptions {
  Intervals method = Intervals::kProfile;
  std::vector<FitPoint> ends = {};  // other local optima, only with effects; internal units
  std::vector<int> degrees = {};    // of freedom, of each standard error; empty: the spare readings
  int threads = 0;
  bool final = false;  // true: profiles continue past a lower optimum
};

struct CurveIntervals : IntervalReport {
  std::vector<double> lower_optimum = {};  // that a profile found, in internal units; empty: none
  FitCovariance covariance = {};           // empty without symmetric intervals
};

// FindIntervals for one curve; `estimates` as in IntervalProblem. Profiles use Coarsen(problem).
CurveIntervals FindIntervals(const CurveEnd& fit, std::vector<Estimate> estimates,
                             const CurveIntervalOptions& options, const ProgressReporter& progress);

}  // namespace lyrefit
