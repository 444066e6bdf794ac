#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {

struct SolveOptions {
  bool bounded = false;
  // Uses SolveLeastSquares if the problem is small and its blocks have no local unknowns.
  bool small = false;
  int max_iterations = 0;
  double function_tolerance = 0;  // relative decrease of the sum of squares that ends the solve
  double trust_radius = 0;        // of the first step
  double unit_A = 1;         // unit of the residuals; makes tolerances independent of the problem
  double target = 0;         // sum of squares in unit_A^2 that ends the solve
  double cutoff = HUGE_VAL;  // in unit_A^2, as in LeastSquaresOptions; Ceres ignores it
  StopToken stop;            // polled once per iteration; a stop ends at this point
};

struct SolveEnd {
  std::vector<double> theta;
  std::vector<double> local;
  bool converged = false;
  bool stopped = false;   // by SolveOptions::stop
  bool hopeless = false;  // `cutoff` is out of reach
  int iterations = 0;
};

// One least-squares solve from the start of `coordinates` and from `local`. Ceres solves it: dense
// QR, or the Schur complement of the shared coordinates if blocks have local unknowns. A bounded
// solve starts inside the bounds. Returns the start if it has a number that is not finite.
SolveEnd SolveModel(const FitModel& model, const Coordinates& coordinates,
                    std::vector<double> local, const SolveOptions& options);

}  // namespace lyrefit
