#pragma once

#include <cmath>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/model.h"

namespace lyrefit {

struct RefineOptions {
  int max_iterations = 2000;          // of one least-squares solve
  double function_tolerance = 1e-15;  // relative decrease of the sum of squares that ends a solve
  int max_rounds = 30;                // of finding the active bounds
  bool add_diodes = true;             // whether a dropped diode may be added again
  double target = 0;                  // A^2; iterations end at or below this mean square
  StopToken stop;                     // polled once per iteration; a stop ends at this point
  // Solves small problems in fewer evaluations (SolveOptions::small), without further rounds if the
  // first solve converged inside the bounds. For fits by the hundred that need not be exact.
  bool small = false;
  // One curve only: whether a point with slowly converging currents counts as a point that cannot
  // be evaluated (GiveUp::kSlow).
  bool evaluation_limit = false;
  // Mean square in A^2; the solve of a small problem ends as soon as this value is out of reach.
  double cutoff = HUGE_VAL;
  // Limits of the first, bounded solve. The rounds start from any end of it, and it converges
  // slowly if a bound is active.
  double first_tolerance = 1e-9;
  int first_iterations = 40;
  // Trust radius of a solve's first step. Starts of one curve are good: close to Gauss-Newton
  // steps.
  double trust_radius = 1e10;
};

// End of a fit.
struct RefineEnd : FitPoint {
  double mean_square = 0;  // FitModel::MeanSquare, A^2
  bool converged = false;
  bool stopped = false;      // by RefineOptions::stop
  int iterations = 0;        // Levenberg-Marquardt iterations, all rounds
  std::vector<bool> active;  // fixed, at a bound, or of a dropped diode
  // Largest cosine between the residual vector and a Jacobian column along which the parameter is
  // free to move downhill. 0 at an exact optimum.
  double projected_gradient = 1;
};

// Bounded least squares from `start`, which is clamped into the bounds. A bounded solve comes
// first. Rounds follow: fix the parameters with an active bound, solve without bounds in the
// others, release one bound along which the sum of squares falls inward. The bounded solver alone
// stalls 1e-7 to 1e-5 above the optimum when a bound is active. A diode that may vanish is dropped
// when its current is negligible. It is added again at the n of its range whose diode current
// correlates most with the residuals. Never ends above its start. Returns a start that is not
// finite unchanged.
RefineEnd RefineModel(const FitModel& model, FitPoint start, const RefineOptions& options = {});

// One bounded solve in all parameters at once: the usual least-squares step after a metaheuristic,
// and the reference for measuring RefineModel. Reads only the options `max_iterations`,
// `function_tolerance`, `target`, `stop` and `evaluation_limit`.
RefineEnd RefineModelPlainly(const FitModel& model, FitPoint start,
                             const RefineOptions& options = {});

}  // namespace lyrefit
