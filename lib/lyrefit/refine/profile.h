#pragma once

#include <vector>

#include "lyrefit/refine/problem.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

// One side of a profile-likelihood interval (Bates and Watts 1988, section 6.1): the value of
// parameter i, left (or right) of the optimum, at which the sum of squares refitted in all other
// parameters has risen to best (1 + t^2 / degrees of freedom); the bound, if it does not rise that
// far inside it.
struct ProfileSide {
  double value = 0;
  bool at_bound = false;
  int refits = 0;
  // A refit that came out below the optimum it started from, if any: that was not the optimum.
  std::vector<double> better;
};

struct ProfileQuery {
  int parameter = 0;
  bool upper = false;
  double t = 2;  // quantile of Student's t
  int degrees_of_freedom = 1;
  double standard_error = 0;  // first guess of the scale; NaN or 0: none
};

ProfileSide FindProfileSide(const RefineProblem& problem, const RefineEnd& best,
                            const ProfileQuery& query);

}  // namespace lyrefit
