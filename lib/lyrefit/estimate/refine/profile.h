#pragma once

#include <functional>
#include <vector>

#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/problem.h"

namespace lyrefit {

// One side of a profile-likelihood interval (Bates and Watts 1988, section 6.1). Its value is that
// of parameter i, left (or right) of the optimum, at which the sum of squares, refitted in all
// other unknowns, has risen by t^2 x variance. It is the bound if the rise inside the bound is
// smaller. Accurate to 0.3 % of the root of the rise; a refit ends as soon as it decides the
// comparison.
struct ProfileSide {
  double value = 0;
  bool at_bound = false;
  // False: the crossing was not found within the allowed refits, or its search ended early. `value`
  // is then the nearest point known to lie outside, or the bound.
  bool settled = true;
  bool stopped = false;  // by the `stop` of a refit
  int refits = 0;
  // The lowest refit below the optimum of the start, if any: the start was then not the optimum.
  std::vector<double> better;
};

struct ProfileQuery {
  int parameter = 0;
  bool upper = false;
  double t = 2;                // quantile of Student's t
  double variance = 0;         // of a residual of weight 1, in A^2
  double standard_error = 0;   // first guess of the scale; NaN or 0: none
  bool end_at_better = false;  // whether a refit below the optimum ends the search
  // Other optima compatible with the data. The interval is the hull of those of all optima.
  std::vector<FitPoint> local_optima = {};
};

// The refits that a profile calls.
struct ProfileRefits {
  // The fit from `start` with the query's parameter fixed at `value`. It may end at a mean square
  // of `target`, or at a relative decrease of the sum of squares below `tolerance`.
  std::function<RefineEnd(double value, const FitPoint& start, double target, double tolerance)>
      refit;
  // Whether a fit from another start ends at or below `target`; `there` receives its end. May be
  // empty: there is only one local optimum.
  std::function<bool(double value, double target, double tolerance, FitPoint* there)> elsewhere;
};

// Cheap solver options for the hundreds of refits of a profile.
RefineOptions ProfileOptions(const StopToken& stop);

ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            const ProfileRefits& refits);

// FindProfileSide by RefineModel with the query's parameter fixed. `how`: the options of a refit;
// with `small`, its first solve has the tolerance of the profile too.
ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            RefineOptions how);

// FindProfileSide for one curve. Diodes that differ only in their order keep it, that of rising n:
// otherwise each would take the other's place along its profile. `stop` is polled once per iteration
// of every refit.
ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const StopToken& stop = {});

}  // namespace lyrefit
