#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "lyrefit/refine/model.h"

namespace lyrefit {

struct RefineOptions {
  int max_iterations = 2000;          // of one least-squares solve
  double function_tolerance = 1e-15;  // relative decrease of the sum of squares that ends a solve
  int max_rounds = 30;                // of settling which bounds are active
  bool let_in = true;                 // whether what has vanished may come back
  double enough = 0;                  // A^2: a mean square at or below which nothing more is done
  std::function<bool()> stop;         // asked once an iteration; true: end where it stands
  // Small problems are solved in fewer evaluations (SolveOptions::small) and end with their first
  // solve where nothing speaks against it. For fits by the hundred, which need not be exact.
  bool small = false;
  // Of one curve: whether places whose currents are slow to be had are taken for places that have
  // none.
  bool evaluation_limit = false;
  // A mean square that a small problem gives up on when it is out of reach.
  double cutoff = HUGE_VAL;
  // Of the first solve, which has the bounds: the rounds go on from wherever it comes to, and where
  // one is active it would creep.
  double first_tolerance = 1e-9;
  int first_iterations = 40;
  // Of a solve's first step. Of one curve the starts are good: close to Gauss-Newton steps.
  double trust_radius = 1e10;
};

// Where a fit ended.
struct RefineEnd : FitPoint {
  double mean_square = 0;  // of FitModel::MeanSquare, A^2
  bool converged = false;
  bool stopped = false;    // as `stop` asked
  int iterations = 0;      // Levenberg-Marquardt iterations, all rounds
  std::vector<bool> held;  // fixed, at a bound, or of what has vanished
  // Largest cosine between the residual vector and a Jacobian column along which the parameter is
  // free to move downhill. 0 at an exact optimum.
  double projected_gradient = 1;
};

// Bounded least squares from `start` (clamped into the bounds): a bounded solve first, then rounds
// of (hold what presses against its bound, solve unbounded in what is left, release what wants back
// in), since the bounded solver alone stalls 1e-7 to 1e-5 above the optimum when a bound is active.
// A diode that may vanish and has faded from the data is taken out, and let in again wherever in
// the range of its n the residuals ask for one. Never ends above its start. A start that is not
// finite comes back as it is.
RefineEnd RefineModel(const FitModel& model, FitPoint start, const RefineOptions& options = {});

// One bounded solve in all parameters at once and nothing more: what a metaheuristic followed by
// least squares usually means, and the yardstick for RefineModel. Of the options it reads
// `max_iterations`, `function_tolerance`, `enough`, `stop` and `evaluation_limit`.
RefineEnd RefineModelPlainly(const FitModel& model, FitPoint start,
                             const RefineOptions& options = {});

}  // namespace lyrefit
