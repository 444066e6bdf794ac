#pragma once

#include <functional>
#include <vector>

#include "lyrefit/base/numbers.h"

namespace lyrefit {

// A least-squares problem of any origin: minimise the sum of squares of `residuals` numbers over
// parameters between bounds.
struct LeastSquaresProblem {
  int residuals = 0;
  std::vector<double> lower;  // -+infinity where there is no bound
  std::vector<double> upper;
  std::vector<char> held;  // 1: stays at its start; empty: all move
  // Residuals at `p` and, where `jacobian` is given, their derivatives row by row. False where the
  // model cannot be evaluated: the step is shortened.
  std::function<bool(const double* p, double* residuals, double* jacobian)> evaluate;
};

struct LeastSquaresOptions {
  int max_iterations = 60;
  double function_tolerance = 1e-9;  // relative change of the sum of squares
  // A sum of squares that others reached: where steps do not promise to come near it, the descent
  // ends.
  double cutoff = kInfinity;
  // Of the first step, in squared lengths of the columns: directions that are so much weaker than
  // the columns by themselves are held back.
  double trust_radius = 1e4;
  double enough = 0;           // a sum of squares at or below which nothing more is done
  std::function<bool()> stop;  // asked once a step; true: end where it stands; may be empty
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
  bool stopped = false;   // as `stop` asked
  bool hopeless = false;  // `cutoff` is out of reach
  int iterations = 0;
};

// Levenberg and Marquardt's method between bounds from `start`, which is moved inside them; made
// for some ten parameters. One evaluation with derivatives a step. (Ceres takes three to five for
// the same: its bounded steps search along a line, and it asks for values and derivatives in turn.)
LeastSquaresEnd SolveLeastSquares(const LeastSquaresProblem& problem,
                                  const std::vector<double>& start,
                                  const LeastSquaresOptions& options = {});

}  // namespace lyrefit
