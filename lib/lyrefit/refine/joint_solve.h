#pragma once

#include <vector>

#include "lyrefit/refine/joint_coordinates.h"

namespace lyrefit {

// Coordinates of the point they were made at, moved into their bounds.
std::vector<double> StartInside(const JointCoordinates& coordinates);

struct JointStep {
  JointPoint point;
  bool converged = false;
  bool stopped = false;
  int iterations = 0;
};

struct JointStepOptions {
  double unit_A = 1;  // of the residuals, so that tolerances mean the same for every problem
  bool bounded = false;
};

// One least-squares solve by Ceres over the coordinates and the curves' own unknowns from `start`.
JointStep SolveJointly(const JointProblem& problem, const JointCoordinates& coordinates,
                       const JointPoint& start, const JointStepOptions& how,
                       const JointOptions& options);

}  // namespace lyrefit
