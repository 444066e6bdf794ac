#pragma once

#include <vector>

#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/fit/fit_watch.h"
#include "lyrefit/refine/error_model.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

struct IntervalInput {
  const RefineProblem& problem;
  const RefineEnd& end;
  const std::vector<FitPoint>& ends;  // of other fits, of a device with effects
  Intervals method = Intervals::kProfile;
  int free_parameters = 0;
  int readings = 0;  // that are no copies of others
  int threads = 0;
  FitWatch* watch;
  bool final = false;  // true: the profiles go on where one comes upon a lower optimum
  // The errors that the residuals have, in A, where they are others than the fit took them for: a
  // profile then goes as much further as the standard error is larger.
  const ErrorModel* errors = nullptr;
  std::vector<int> degrees =
      {};  // of each estimate's standard error; empty: what is left of points
};

// Those of every estimate alone; NaN where there is none.
std::vector<double> StandardErrors(const IntervalInput& input);

// Fills standard errors, intervals, marks and reasons of `estimates`, and correlations and
// condition. The profiles are those of Thin(problem). Returns parameters of a lower optimum if a
// profile came upon one, else an empty vector.
std::vector<double> FindIntervals(const IntervalInput& input, std::vector<Estimate>* estimates,
                                  std::vector<Correlation>* correlations, double* condition);

}  // namespace lyrefit
