#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/refine/joint_residuals.h"

namespace lyrefit {

// All residuals of a joint problem (ampere, weighted, priors included) and their derivatives at a
// point.
struct JointLinear {
  Eigen::VectorXd residual;
  RowMatrix shared;               // rows x moving shared coordinates
  std::vector<RowMatrix> local;   // of each curve: its rows x its own unknowns
  std::vector<int> first_row;     // of each curve
  std::vector<int> parameter;     // of each column of `shared`
  Eigen::MatrixXd natural_slope;  // natural shared parameters by coordinates
};

JointLinear LinearizeJointly(const JointProblem& problem, const JointPoint& point,
                             const std::vector<bool>& held);

// Linearised uncertainty at the end of a joint fit, as FindSensitivity gives it for one curve:
// inverse of J'J times `variance`, the curves' own unknowns eliminated. What moves along a
// direction without influence on any residual has no standard error; the others keep theirs.
struct JointSpread {
  std::vector<double>
      standard_error;           // of each natural shared parameter; NaN: held or undetermined
  Eigen::MatrixXd correlation;  // shared x shared, 0 where not known
  // Of the natural shared parameters, from the directions that the data decide; and a column of
  // `open` for every direction along which no residual changes.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd open;
  std::vector<JointLocal> local_error;  // standard errors of the curves' own unknowns
  double condition = 1;                 // of the Jacobian with columns of length 1
  double local_degrees = 0;  // how many unknowns of their own the curves have beyond their priors
};

JointSpread FindJointSpread(const JointProblem& problem, const JointEnd& end, double variance);

}  // namespace lyrefit
