#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/prepare_fit.h"

namespace lyrefit {

// Third stage of a fit: the polished end, and the problem whose least-squares solution it is.
struct RefinedFit {
  PreparedFit prepared;  // in the selected variant
  RefineProblem problem =
      {};  // prepared.problem, with the weights of a robust loss or of an error model
  RefineEnd end = {};
  std::vector<FitPoint> ends = {};  // other local optima, only with effects
  RefineReport report = {};
  std::vector<VariantReport> variants = {};
  std::vector<double> best_candidate = {};  // the best candidate after its own polish; may be empty
  std::optional<ErrorReport> errors = {};   // if an error model weighed the readings
  std::vector<int> degrees =
      {};  // of freedom, of each standard error; empty: readings minus parameters
};

// The best candidate after one bounded solve, and after its full polish.
struct PlainPolish {
  RmsePair rmse;  // of the bounded solve
  double seconds = 0;
  std::vector<double> best_candidate;  // after the full polish
  double best_candidate_seconds = 0;
};
PlainPolish PolishPlainly(const PreparedFit& fit, const PolishStart& candidate,
                          const ProgressReporter& progress);

// Polishes the candidates of the search and other starts, and weighs the readings as the options
// request.
RefinedFit RefineFit(const PreparedFit& fit, const std::vector<PolishStart>& candidates,
                     const SearchSpace& space, const ProgressReporter& progress);

}  // namespace lyrefit
