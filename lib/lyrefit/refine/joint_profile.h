#pragma once

#include <functional>

#include "lyrefit/refine/joint.h"

namespace lyrefit {

// One side of a profile-likelihood interval of a shared parameter in a joint problem (Bates and
// Watts 1988, section 6.1), as FindProfileSide for one curve.
struct JointProfileSide {
  double value = 0;
  bool at_bound = false;
  bool stopped = false;  // as `proceed` asked: `value` says nothing
  int refits = 0;
};

struct JointProfileQuery {
  int parameter = 0;  // shared
  bool upper = false;
  double t = 2;                   // quantile of Student's t
  double variance = 0;            // of a point of weight 1, in A^2
  double standard_error = 0;      // first guess of the scale; NaN or 0: none
  std::function<bool()> proceed;  // as in JointOptions
};

JointProfileSide FindJointProfileSide(const JointProblem& problem, const JointEnd& best,
                                      const JointProfileQuery& query);

}  // namespace lyrefit
