#include "lyrefit/certify/cause_upper_bound.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/bounded_linear.h"
#include "lyrefit/estimate/refine/least_squares.h"

namespace lyrefit {
namespace {

constexpr double kDifference = 1e-5;  // finite-difference step, in sizes of the coordinate
constexpr int kMostSteps = 40;

// Weighted residuals at this Rs and u with the best strengths within their ranges.
Eigen::VectorXd Leave(const MixtureData& data, double rs, double u) {
  const Eigen::VectorXd vd = data.JunctionVoltage(rs);
  const auto terms = static_cast<Eigen::Index>(data.terms.size());
  Eigen::MatrixXd a(vd.size(), terms + 1);
  Eigen::VectorXd lower = Eigen::VectorXd::Zero(terms + 1);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(terms + 1, kInfinity);
  for (Eigen::Index j = 0; j <= terms; ++j) {
    const Eigen::VectorXd column = j < terms ? data.terms[static_cast<std::size_t>(j)].Column(vd)
                                             : DiodeColumn(vd, vd.maxCoeff(), u);
    const double size = std::max(column.cwiseAbs().maxCoeff(), 1e-300);
    a.col(j) = data.weight.cwiseProduct(column) / size;
    if (j == terms) continue;
    lower[j] = data.terms[static_cast<std::size_t>(j)].lower * size;
    upper[j] = data.terms[static_cast<std::size_t>(j)].upper * size;
  }
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(terms + 1).cwiseMax(lower).cwiseMin(upper);
  const Eigen::VectorXd target = data.WeightedTarget();
  return Residual(target, a, SolveBoundedColumns(a, target, lower, upper, start));
}

Eigen::VectorXd LeaveAt(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                        const double* p) {
  if (shape == nullptr) return Leave(data, p[0], std::exp(p[1]));
  return Leave(WithCause(data, shape, {p[2]}), p[0], std::exp(p[1]));
}

}  // namespace

MixtureData WithCause(MixtureData data, const std::shared_ptr<const CauseShape>& shape,
                      const std::vector<double>& thetas) {
  if (shape == nullptr) return data;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(data.voltage_V.size());
  for (const double theta : thetas) {
    data.terms.push_back({zero, zero, 0, shape->strongest_A, shape, theta});
  }
  return data;
}

void Evaluate(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
              CausePoint* point) {
  const double p[] = {point->rs, std::log(point->u), point->theta};
  point->primal = 0.5 * LeaveAt(data, shape, p).squaredNorm();
}

CausePoint Descend(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                   const CauseRegion& region, const CausePoint& start) {
  const Span theta = shape != nullptr ? shape->theta : Span{};
  LeastSquaresProblem problem;
  problem.residuals = static_cast<int>(data.voltage_V.size());
  problem.lower = {region.rs_lower, std::log(region.u.lower), theta.lower};
  problem.upper = {region.rs_upper, std::log(region.u.upper), theta.upper};
  problem.fixed = {region.rs_lower == region.rs_upper, region.u.lower == region.u.upper,
                   theta.lower == theta.upper};
  const double sizes[] = {std::max(region.rs_upper - region.rs_lower, 1e-300), 1, 1};
  problem.evaluate = [&](const double* p, double* residuals, double* jacobian) {
    const Eigen::VectorXd at = LeaveAt(data, shape, p);
    for (Eigen::Index k = 0; k < at.size(); ++k) residuals[k] = at[k];
    if (jacobian == nullptr) return true;
    for (int j = 0; j < 3; ++j) {
      double moved[] = {p[0], p[1], p[2]};
      const double step = kDifference * sizes[j] * (p[j] > problem.lower[j] ? -1 : 1);
      moved[j] += step;
      const Eigen::VectorXd next = problem.fixed[j] != 0 ? at : LeaveAt(data, shape, moved);
      for (Eigen::Index k = 0; k < at.size(); ++k) {
        jacobian[3 * k + j] = (next[k] - at[k]) / step;
      }
    }
    return true;
  };
  const LeastSquaresEnd end = SolveLeastSquares(problem, {start.rs, std::log(start.u), start.theta},
                                                UpTo(kMostSteps, 1e-7));
  if (!end.usable) return start;
  CausePoint best = {end.p[0], std::exp(end.p[1]), end.p[2], 0.5 * end.sum_of_squares};
  best.u = std::min(std::max(best.u, region.u.lower), region.u.upper);
  Evaluate(data, shape, &best);
  return best.primal < start.primal ? best : start;
}

}  // namespace lyrefit
