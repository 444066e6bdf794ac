#include "lyrefit/estimate/refine/linear_part.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

// The normal equations square the condition number of the columns. One step of iterative refinement
// with the true residual restores the digits.
void SharpenFree(const SmallVector& lower, const SmallVector& upper, LinearPart* linear) {
  const int count = static_cast<int>(linear->free.size());
  SmallMatrix gram(count, count);
  SmallVector pull(count);
  const Eigen::VectorXd residual = linear->columns * linear->x - linear->target;
  for (int a = 0; a < count; ++a) {
    pull[a] = linear->columns.col(linear->free[a]).dot(residual);
    for (int b = 0; b < count; ++b) gram(a, b) = linear->gram(linear->free[a], linear->free[b]);
  }
  const SmallVector step = gram.ldlt().solve(pull);
  for (int a = 0; a < count; ++a) {
    const double value = linear->x[linear->free[a]] - step[a];
    if (!(value >= lower[linear->free[a]] && value <= upper[linear->free[a]])) return;
  }
  for (int a = 0; a < count; ++a) linear->x[linear->free[a]] -= step[a];
}

}  // namespace

LinearPart MakeLinearColumns(const RefineProblem& problem, const std::vector<double>& weights,
                             double rs, const std::vector<double>& idealities) {
  const int points = static_cast<int>(problem.voltage_V.size());
  const int count = 2 + static_cast<int>(idealities.size());
  LinearPart linear;
  linear.columns.resize(points, count);
  linear.target.resize(points);
  Eigen::VectorXd root(points);
  for (int k = 0; k < points; ++k) {
    const double vd = problem.voltage_V[k] + rs * problem.current_A[k];
    linear.columns(k, 0) = 1;
    linear.columns(k, 1) = -vd;
    for (int j = 2; j < count; ++j) {
      const double exponent = vd / (idealities[j - 2] * problem.device.module_thermal_voltage_V);
      linear.columns(k, j) = DiodeCurrent(1.0, 1.0, exponent);
    }
    root[k] = std::sqrt(weights[k]);
    linear.target[k] = root[k] * problem.current_A[k];
  }
  linear.scale = linear.columns.cwiseAbs().colwise().maxCoeff().cwiseMax(1e-300);
  linear.columns = root.asDiagonal() * linear.columns * linear.scale.cwiseInverse().asDiagonal();
  return linear;
}

void LinearBounds(const RefineProblem& problem, const Eigen::VectorXd& scale, SmallVector* lower,
                  SmallVector* upper) {
  lower->resize(scale.size());
  upper->resize(scale.size());
  const auto range = [&](int column, double low, double high) {
    (*lower)[column] = low * scale[column];
    (*upper)[column] = high * scale[column];
  };
  range(0, problem.lower[kIph], problem.upper[kIph]);
  range(1, 1 / std::max(problem.upper[kRsh], kSmallestResistance_ohm),
        1 / std::max(problem.lower[kRsh], kSmallestResistance_ohm));
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int is = SaturationCurrentIndex(d);
    range(2 + d, problem.lower[is], problem.upper[is]);
  }
}

LinearPart SolveLinearPart(const RefineProblem& problem, const std::vector<double>& weights,
                           double rs, const std::vector<double>& idealities) {
  LinearPart linear = MakeLinearColumns(problem, weights, rs, idealities);
  SmallVector lower, upper;
  LinearBounds(problem, linear.scale, &lower, &upper);
  linear.gram.noalias() = linear.columns.transpose() * linear.columns;
  linear.x =
      SolveBoundedLinear(linear.gram, linear.columns.transpose() * linear.target, lower, upper);
  const int count = static_cast<int>(linear.x.size());
  for (int j = 0; j < count; ++j) {
    if (linear.x[j] > lower[j] && linear.x[j] < upper[j]) linear.free.push_back(j);
  }
  if (!linear.free.empty()) SharpenFree(lower, upper, &linear);
  linear.residual = linear.columns * linear.x - linear.target;
  return linear;
}

std::vector<double> ToParameters(const RefineProblem& problem, const LinearPart& linear, double rs,
                                 const std::vector<double>& idealities) {
  std::vector<double> p(problem.device.size());
  p[kIph] = linear.x[0] / linear.scale[0];
  p[kRs] = rs;
  p[kRsh] = linear.scale[1] / std::max(linear.x[1], 1e-300);
  for (std::size_t d = 0; d < idealities.size(); ++d) {
    const int diode = static_cast<int>(d);
    p[SaturationCurrentIndex(diode)] = linear.x[2 + diode] / linear.scale[2 + diode];
    p[IdealityIndex(diode)] = idealities[d];
  }
  for (int i = 0; i < problem.device.size(); ++i) {
    p[i] = std::min(std::max(p[i], problem.lower[i]), problem.upper[i]);
  }
  return p;
}

}  // namespace lyrefit
