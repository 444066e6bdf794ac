#pragma once

#include <ceres/cost_function.h>

#include "lyrefit/refine/residuals.h"

namespace lyrefit {

// CurveResiduals as Ceres asks for them.
class PolishCost : public ceres::CostFunction {
 public:
  PolishCost(const RefineProblem& problem, const Coordinates& coordinates, double unit_A)
      : residuals_(problem, coordinates, unit_A) {
    set_num_residuals(static_cast<int>(problem.voltage_V.size()));
    mutable_parameter_block_sizes()->push_back(coordinates.size());
  }
  bool Evaluate(double const* const* theta, double* residuals, double** jacobians) const override {
    return residuals_.Evaluate(theta[0], residuals, jacobians ? jacobians[0] : nullptr);
  }

 private:
  CurveResiduals residuals_;
};

}  // namespace lyrefit
