#include "lyrefit/estimate/refine/linear_part.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/refine/model_current.h"

namespace lyrefit {
namespace {

Eigen::VectorXd Misfit(const LinearPart& linear) {
  Eigen::VectorXd misfit = -linear.target;
  for (int j = 0; j < linear.x.size(); ++j) misfit += linear.x[j] * linear.columns.col(j);
  return misfit;
}

// The normal equations square the condition number of the columns. One step of iterative refinement
// with the true residual restores the digits.
void SharpenFree(const SmallVector& lower, const SmallVector& upper, LinearPart* linear) {
  const int count = static_cast<int>(linear->free.size());
  SmallMatrix gram(count, count);
  SmallVector pull(count);
  const Eigen::VectorXd residual = Misfit(*linear);
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
  const int count = static_cast<int>(idealities.size());
  const std::size_t length = problem.points.voltage_V.size();
  thread_local std::vector<PreparedTerm<double>> diodes;
  diodes.clear();
  for (const double n : idealities) {
    diodes.push_back({TermKind::kDiode, 1.0, 1 / (n * problem.device.module_thermal_voltage_V)});
  }
  Block* const rows = ScratchBlocks((2 + 2 * count) * length);
  problem.kernel->explicit_currents(diodes.data(), count, rs, problem.points,
                                    problem.points.current_A.data(), rows);
  const auto measured = [&](const std::vector<double>& values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(), points);
  };
  LinearPart linear;
  linear.vd = measured(problem.voltage_V) + rs * measured(problem.current_A);
  linear.root = measured(weights).cwiseSqrt();
  linear.target = linear.root.cwiseProduct(measured(problem.current_A));
  linear.columns.resize(points, 2 + count);
  linear.scale.resize(2 + count);
  const auto set = [&](int j, const auto& column) {
    linear.scale[j] = std::max(column.cwiseAbs().maxCoeff(), 1e-300);
    linear.columns.col(j) = column.cwiseProduct(linear.root) / linear.scale[j];
  };
  set(0, Eigen::VectorXd::Ones(points));
  set(1, -linear.vd);
  for (int j = 0; j < count; ++j) {
    set(2 + j, Eigen::Map<const Eigen::VectorXd>(NumbersOf(rows + (2 + 2 * j) * length), points));
  }
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
  const int count = static_cast<int>(lower.size());
  linear.gram.resize(count, count);
  SmallVector atb(count);
  for (int j = 0; j < count; ++j) {
    atb[j] = linear.columns.col(j).dot(linear.target);
    for (int i = 0; i <= j; ++i) {
      linear.gram(i, j) = linear.gram(j, i) = linear.columns.col(i).dot(linear.columns.col(j));
    }
  }
  linear.x = SolveBoundedLinear(linear.gram, atb, lower, upper);
  for (int j = 0; j < count; ++j) {
    if (linear.x[j] > lower[j] && linear.x[j] < upper[j]) linear.free.push_back(j);
  }
  if (!linear.free.empty()) SharpenFree(lower, upper, &linear);
  linear.residual = Misfit(linear);
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
