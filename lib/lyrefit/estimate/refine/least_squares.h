#pragma once

#include <functional>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/observer.h"

namespace lyrefit {

// A general least-squares problem: minimise the sum of squares of `residuals` numbers over
// parameters between bounds.
struct LeastSquaresProblem {
  int residuals = 0;
  std::vector<double> lower;  // -+infinity: no bound
  std::vector<double> upper;
  std::vector<char> fixed;  // 1: stays at its start; empty: all are free
  // Residuals at `p` and, if `jacobian` is not null, their derivatives row by row. False if the
  // model cannot be evaluated: the step is then shortened.
  std::function<bool(const double* p, double* residuals, double* jacobian)> evaluate;
};

struct LeastSquaresOptions {
  int max_iterations = 60;
  double function_tolerance = 1e-9;  // relative change of the sum of squares
  // A sum of squares reached by other candidates. The descent ends if its steps are not predicted
  // to come near it.
  double cutoff = kInfinity;
  // Trust radius of the first step, relative to the squared lengths of the columns: damps
  // directions that are weaker than the single columns by this factor.
  double trust_radius = 1e4;
  double target = 0;  // the descent ends at or below this sum of squares
  StopToken stop;     // polled once per step; a stop ends at this point
};

inline LeastSquaresOptions UpTo(int max_iterations, double function_tolerance) {
  LeastSquaresOptions options;
  options.max_iterations = max_iterations;
  options.function_tolerance = function_tolerance;
  return options;
}

struct LeastSquaresEnd {
  std::vector<double> p;
  double sum_of_squares = 0;
  bool converged = false;
  bool usable = false;    // false: the start itself could not be evaluated
  bool stopped = false;   // by LeastSquaresOptions::stop
  bool hopeless = false;  // `cutoff` is out of reach
  int iterations = 0;
};

// Levenberg-Marquardt method between bounds from `start`, which is clamped into them; for about ten
// parameters. One evaluation with derivatives per step. (Ceres needs three to five: its bounded
// steps search along a line, and it requests values and derivatives in turn.)
LeastSquaresEnd SolveLeastSquares(const LeastSquaresProblem& problem,
                                  const std::vector<double>& start,
                                  const LeastSquaresOptions& options = {});

}  // namespace lyrefit
