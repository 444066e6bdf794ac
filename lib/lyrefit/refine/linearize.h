#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/refine/coordinates.h"

namespace lyrefit {

// Residuals of a block in units of `unit_A` at the coordinates `theta` and, where asked for, their
// derivatives row by row by the coordinates and by the block's own unknowns. False where the model
// cannot be evaluated or a number is not finite.
bool EvaluateBlock(const FitModel& model, const Coordinates& coordinates, int block,
                   const double* theta, const double* local, double unit_A, double* residuals,
                   double* slopes, double* local_slopes);

// All residuals of a model in ampere and their derivatives at a point. Blocks that cannot be
// evaluated there are 0.
struct Linearization {
  Eigen::VectorXd residual;
  RowMatrix jacobian;             // residuals x coordinates of what is not held
  std::vector<RowMatrix> local;   // of each block: its residuals x its own unknowns
  std::vector<int> first_row;     // of each block
  std::vector<int> parameter;     // of each column of `jacobian`
  Eigen::MatrixXd natural_slope;  // natural parameters by coordinates
};

Linearization Linearize(const FitModel& model, const FitPoint& point,
                        const std::vector<bool>& held);

}  // namespace lyrefit
