#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

struct IntervalInput {
  const RefineProblem& problem;
  const RefineEnd& end;
  const std::vector<FitPoint>& ends;  // other local optima, only with effects
  Intervals method = Intervals::kProfile;
  int free_parameters = 0;
  int readings = 0;  // distinct readings
  int threads = 0;
  const ProgressReporter& progress;
  bool final = false;  // true: profiles continue past a lower optimum
  // Errors of the residuals, in A, if they differ from those that the fit assumed. Each profile is
  // then extended by the ratio of the standard errors.
  const ErrorModel* errors = nullptr;
  std::vector<int> degrees = {};  // of each standard error; empty: readings minus free parameters
};

// Standard errors of all estimates; NaN where there is none.
std::vector<double> StandardErrors(const IntervalInput& input);

// Sets standard errors, intervals, active bounds, identifiability and reasons of `estimates`, and
// the correlations and the condition number. Profiles use Coarsen(problem). Returns the parameters
// of a lower optimum if a profile found one, else an empty vector.
std::vector<double> FindIntervals(const IntervalInput& input, std::vector<Estimate>* estimates,
                                  std::vector<Correlation>* correlations, double* condition);

}  // namespace lyrefit
