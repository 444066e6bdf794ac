#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/problem.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// One side of a profile-likelihood interval (Bates and Watts 1988, section 6.1): the value of
// parameter i, left (or right) of the optimum, at which the sum of squares refitted in all other
// parameters has risen to best (1 + t^2 / degrees of freedom); the bound, if it does not rise that
// far inside it. Found to 0.3 % of the rise; the refits go on until that is known and no further.
struct ProfileSide {
  double value = 0;
  bool at_bound = false;
  // False: the crossing was not met in the refits allowed, or the search for it was ended before.
  // `value` is then the nearest place that is known to lie outside, or the bound.
  bool settled = true;
  int refits = 0;
  // The lowest refit that came out below the optimum it started from, if any: that was not the
  // optimum.
  std::vector<double> better;
};

struct ProfileQuery {
  int parameter = 0;
  bool upper = false;
  double t = 2;  // quantile of Student's t
  int degrees_of_freedom = 1;
  double standard_error = 0;   // first guess of the scale; NaN or 0: none
  bool end_at_better = false;  // a refit below the optimum ends the search for the crossing
};

// `stop` is asked once an iteration of every refit.
ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query, const std::function<bool()>& stop = {});

}  // namespace lyrefit
