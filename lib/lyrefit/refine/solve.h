#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "lyrefit/refine/coordinates.h"

namespace lyrefit {

struct SolveOptions {
  bool bounded = false;
  // By SolveLeastSquares, where the problem is small and its blocks have no unknowns of their own.
  bool small = false;
  int max_iterations = 0;
  double function_tolerance = 0;  // relative decrease of the sum of squares that ends it
  double trust_radius = 0;        // of the first step
  double unit_A = 1;  // of the residuals, so that tolerances mean the same for every problem
  double enough = 0;  // sum of squares, in that unit, at or below which nothing more is done
  double cutoff = HUGE_VAL;   // the same, as in LeastSquaresOptions; Ceres goes on regardless
  std::function<bool()> stop;  // asked once an iteration; true: end where it stands
};

struct SolveEnd {
  std::vector<double> theta;
  std::vector<double> local;
  bool converged = false;
  bool stopped = false;   // as `stop` asked
  bool hopeless = false;  // `cutoff` is out of reach
  int iterations = 0;
};

// One least-squares solve from where `coordinates` were made and `local`. By Ceres: dense QR, or
// the Schur complement of the shared coordinates where blocks have unknowns of their own. A bounded
// one begins inside the bounds. Ends where it began if a number there is not finite.
SolveEnd SolveModel(const FitModel& model, const Coordinates& coordinates,
                    std::vector<double> local, const SolveOptions& options);

}  // namespace lyrefit
