#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/coordinates.h"

namespace lyrefit {

// Residuals of a block in units of `unit_A` at the coordinates `theta`. If requested, also their
// derivatives row by row by the coordinates (`slopes`) and by the block's local unknowns
// (`local_slopes`). False if the model cannot be evaluated or a number is not finite.
bool EvaluateBlock(const FitModel& model, const Coordinates& coordinates, int block,
                   const double* theta, const double* local, double unit_A, double* residuals,
                   double* slopes, double* local_slopes);

// All residuals of a model in ampere and their derivatives at a point. Blocks that cannot be
// evaluated are 0.
struct Linearization {
  Eigen::VectorXd residual;
  RowMatrix jacobian;             // residuals x coordinates of the free parameters
  std::vector<RowMatrix> local;   // of each block: its residuals x its local unknowns
  std::vector<int> first_row;     // of each block
  std::vector<int> parameter;     // parameter of each column of `jacobian`
  Eigen::MatrixXd natural_slope;  // derivatives of the parameters by the coordinates
};

Linearization Linearize(const FitModel& model, const FitPoint& point,
                        const std::vector<bool>& active);

}  // namespace lyrefit
