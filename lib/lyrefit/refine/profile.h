#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/active_set.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// One side of a profile-likelihood interval (Bates and Watts 1988, section 6.1): the value of
// parameter i, left (or right) of the optimum, at which the sum of squares refitted in all other
// unknowns has risen by t^2 x variance; the bound, if it does not rise that far inside it. Found to
// 0.3 % of the rise's root; the refits go on until that is known and no further.
struct ProfileSide {
  double value = 0;
  bool at_bound = false;
  // False: the crossing was not met in the refits allowed, or the search for it was ended before.
  // `value` is then the nearest place that is known to lie outside, or the bound.
  bool settled = true;
  bool stopped = false;  // as a refit was asked to
  int refits = 0;
  // The lowest refit that came out below the optimum it started from, if any: that was not the
  // optimum.
  std::vector<double> better;
};

struct ProfileQuery {
  int parameter = 0;
  bool upper = false;
  double t = 2;                // quantile of Student's t
  double variance = 0;         // of a residual of weight 1, in A^2
  double standard_error = 0;   // first guess of the scale; NaN or 0: none
  bool end_at_better = false;  // a refit below the optimum ends the search for the crossing
  // Other optima, which the data allow as well: the interval is the hull of what all of them allow.
  std::vector<FitPoint> local_optima = {};
};

// What a profile needs to know of the fits behind it.
struct ProfileRefits {
  // The fit from `start` with the query's parameter held at `value`. It need not go below
  // `enough`, nor closer to its end than `tolerance` (relative, of the sum of squares).
  std::function<RefineEnd(double value, const FitPoint& start, double enough, double tolerance)>
      refit;
  // Whether a fit from elsewhere ends at or below `enough`; its place goes to `there`. May be
  // empty: there is one local optimum.
  std::function<bool(double value, double enough, double tolerance, FitPoint* there)> elsewhere;
};

ProfileSide FindProfileSide(const FitModel& model, const RefineEnd& best, const ProfileQuery& query,
                            const ProfileRefits& refits);

// The same for one curve, whose diodes may trade places on the way. `stop` is asked once an
// iteration of every refit.
ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const std::function<bool()>& stop = {});

}  // namespace lyrefit
