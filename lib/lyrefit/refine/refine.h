#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/problem.h"

namespace lyrefit {

struct RefineOptions {
  int max_iterations = 2000;          // of one least-squares solve
  double function_tolerance = 1e-15;  // relative decrease of the sum of squares that ends a solve
  int max_rounds = 30;                // of settling which bounds are active
  bool let_diodes_in = true;          // whether a diode that has vanished may come back
  double enough = 0;                  // A^2: a mean square at or below which nothing more is done
  std::function<bool()> stop;         // asked once an iteration; true: end where it stands
};

// Where a polish ended.
struct RefineEnd {
  std::vector<double> p;
  double mean_square = 0;  // weighted, A^2
  bool converged = false;
  int iterations = 0;      // Levenberg-Marquardt iterations, all rounds
  std::vector<bool> held;  // fixed, at a bound, or of a diode that has vanished
  // Largest cosine between the residual vector and a Jacobian column along which the parameter is
  // free to move downhill. 0 at an exact optimum.
  double projected_gradient = 1;
};

// Bounded least squares from `start` (clamped into the bounds; infinities not allowed): a bounded
// Ceres solve first, then rounds of (hold what presses against its bound, solve unbounded in what
// is left, release what wants back in), since the bounded solver alone stalls 1e-7 to 1e-5 above
// the optimum when a bound is active. A diode whose saturation current may be 0 and which has faded
// from the data is taken out, and let in again wherever in the range of n the residuals ask for
// one. Never ends above its start. A start that is not finite comes back as it is.
RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options = {});

// SeparableDescent, with the tolerance of `options` but no finer than its own, then Refine. Never
// ends above `start`: where the descent led astray, Refine goes from the start itself.
RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options = {});

// One bounded Ceres solve in all parameters at once and nothing more: what a metaheuristic followed
// by least squares usually means, and the yardstick for Refine. `max_rounds` is not used.
RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options = {});

}  // namespace lyrefit
