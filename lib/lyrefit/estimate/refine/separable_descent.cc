#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/linear_part.h"
#include "lyrefit/estimate/refine/model_current.h"
#include "lyrefit/estimate/refine/separable.h"

namespace lyrefit {
namespace {

constexpr int kMaxSteps = 60;

// The reduced problem in theta = (Rs / R0, 1/n of each diode).
class Descent {
 public:
  Descent(const RefineProblem& problem, const std::vector<double>& start, double tolerance)
      : problem_(problem), tolerance_(tolerance), weights_(problem.weights) {
    const int diodes = DiodeCount(problem.device);
    theta_.resize(1 + diodes);
    lower_.resize(1 + diodes);
    upper_.resize(1 + diodes);
    const double r0 = problem.resistance_scale();
    theta_[0] = start[kRs] / r0;
    lower_[0] = problem.lower[kRs] / r0;
    upper_[0] = problem.upper[kRs] / r0;
    for (int d = 0; d < diodes; ++d) {
      const int n = IdealityIndex(d);
      theta_[1 + d] = 1 / start[n];
      lower_[1 + d] = 1 / problem.upper[n];
      upper_[1 + d] = 1 / std::max(problem.lower[n], kSmallestIdeality);
    }
    theta_ = theta_.cwiseMax(lower_).cwiseMin(upper_);
    linear_ = Solve(theta_);
  }

  void Run() {
    for (int revived = 0; revived <= DiodeCount(problem_.device); ++revived) {
      Descend();
      if (!ReviveDiode()) return;
    }
  }

  std::vector<double> Parameters() const {
    return ToParameters(problem_, linear_, Rs(theta_), Idealities(theta_));
  }

  // Weights that make the measured-current residual equal to the solved one to first order.
  void WeighForSolvedCurrent() {
    const PreparedDevice prepared = Prepare(problem_.device, Parameters().data());
    const PointSet& points = problem_.points;
    const std::size_t length = points.voltage_V.size();
    Block* const rows = ScratchBlocks((2 + 2 * prepared.count) * length);
    problem_.kernel->explicit_currents(prepared.terms, prepared.count, prepared.rs, points,
                                       points.current_A.data(), rows);
    const double* const slope = NumbersOf(rows + length);
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      const double factor = 1 / (1 - prepared.rs * slope[k]);
      weights_[k] = problem_.weights[k] * factor * factor;
    }
    linear_ = Solve(theta_);
  }

 private:
  double Rs(const Eigen::VectorXd& theta) const { return theta[0] * problem_.resistance_scale(); }
  static std::vector<double> Idealities(const Eigen::VectorXd& theta) {
    std::vector<double> n;
    for (int d = 1; d < theta.size(); ++d) n.push_back(1 / theta[d]);
    return n;
  }
  LinearPart Solve(const Eigen::VectorXd& theta) const {
    return SolveLinearPart(problem_, weights_, Rs(theta), Idealities(theta));
  }
  static double Cost(const LinearPart& linear) { return linear.residual.squaredNorm(); }

  // Derivative of the residual with respect to theta, the free linear unknowns projected out.
  Eigen::MatrixXd Jacobian() const {
    const int points = static_cast<int>(linear_.residual.size());
    const double vt = problem_.device.module_thermal_voltage_V;
    const double r0 = problem_.resistance_scale();
    const Eigen::Map<const Eigen::VectorXd> current(problem_.current_A.data(), points);
    Eigen::MatrixXd j(points, theta_.size());
    j.col(0) = (-r0 * linear_.x[1] / linear_.scale[1]) * linear_.target;
    for (int d = 1; d < theta_.size(); ++d) {
      // A column is 1 - exp(Vd / (n Ns Vt)), scaled.
      const double x = linear_.x[1 + d] / vt;
      j.col(d) = (x / linear_.scale[1 + d]) * linear_.root - x * linear_.columns.col(1 + d);
      j.col(0) -= (theta_[d] * r0) * j.col(d).cwiseProduct(current);
      j.col(d) = -j.col(d).cwiseProduct(linear_.vd);
    }
    const int free = static_cast<int>(linear_.free.size());
    if (free == 0) return j;
    SmallMatrix gram(free, free), inner(free, static_cast<int>(theta_.size()));
    for (int c = 0; c < free; ++c) {
      const auto column = linear_.columns.col(linear_.free[c]);
      for (int r = 0; r < free; ++r) gram(r, c) = linear_.gram(linear_.free[r], linear_.free[c]);
      for (int i = 0; i < j.cols(); ++i) inner(c, i) = column.dot(j.col(i));
    }
    const SmallMatrix step = gram.ldlt().solve(inner);
    for (int i = 0; i < j.cols(); ++i) {
      for (int c = 0; c < free; ++c) j.col(i) -= step(c, i) * linear_.columns.col(linear_.free[c]);
    }
    return j;
  }

  void Descend() {
    double damping = 1e-4;
    for (int step = 0; step < kMaxSteps; ++step) {
      Eigen::MatrixXd j = Jacobian();
      const Eigen::VectorXd gradient = TransposedTimes(j, linear_.residual);
      for (int i = 0; i < theta_.size(); ++i) {
        const bool pressed = (theta_[i] <= lower_[i] && gradient[i] > 0) ||
                             (theta_[i] >= upper_[i] && gradient[i] < 0);
        if (pressed) j.col(i).setZero();
      }
      if (!Step(j, &damping)) return;
    }
  }

  // One accepted step; false if no step lowers the sum of squares further.
  bool Step(const Eigen::MatrixXd& j, double* damping) {
    const Eigen::VectorXd gradient = TransposedTimes(j, linear_.residual);
    const Eigen::MatrixXd hessian = TransposedTimes(j, j);
    const double before = Cost(linear_);
    for (int attempt = 0; attempt < 12; ++attempt) {
      Eigen::MatrixXd damped = hessian;
      for (int i = 0; i < theta_.size(); ++i) {
        damped(i, i) += *damping * hessian(i, i) + (hessian(i, i) > 0 ? 0 : 1);
      }
      const Eigen::VectorXd trial =
          (theta_ - SolveSymmetric(damped, gradient)).cwiseMax(lower_).cwiseMin(upper_);
      LinearPart linear = Solve(trial);
      const double after = Cost(linear);
      if (after < before) {
        theta_ = trial;
        linear_ = std::move(linear);
        *damping = std::max(*damping * 0.1, 1e-12);
        return before - after > tolerance_ * before;
      }
      *damping *= 10;
    }
    return false;
  }

  // Moves a diode without current to the n whose column the residuals correlate with most.
  bool ReviveDiode() {
    constexpr int kSteps = 24;
    for (int d = 1; d < theta_.size(); ++d) {
      if (linear_.x[1 + d] > 0 || lower_[d] == upper_[d]) continue;
      std::vector<double> scan;
      for (int s = 0; s <= kSteps; ++s) {
        scan.push_back(1 / (lower_[d] + s * (upper_[d] - lower_[d]) / kSteps));
      }
      const LinearPart columns = MakeLinearColumns(problem_, weights_, Rs(theta_), scan);
      int best = -1;
      double strongest = 1e-7 * linear_.residual.norm();
      for (int s = 0; s <= kSteps; ++s) {
        const auto column = columns.columns.col(2 + s);
        const double pull = -column.dot(linear_.residual) / column.norm();
        if (pull > strongest) {
          strongest = pull;
          best = s;
        }
      }
      if (best < 0) continue;
      Eigen::VectorXd trial = theta_;
      trial[d] = 1 / scan[best];
      LinearPart linear = Solve(trial);
      if (Cost(linear) >= Cost(linear_) * (1 - 1e-12)) continue;
      theta_ = trial;
      linear_ = std::move(linear);
      return true;
    }
    return false;
  }

  const RefineProblem& problem_;
  const double tolerance_;
  std::vector<double> weights_;
  Eigen::VectorXd theta_;
  Eigen::VectorXd lower_;
  Eigen::VectorXd upper_;
  LinearPart linear_;
};

}  // namespace

std::vector<double> SeparableDescent(const RefineProblem& problem, const std::vector<double>& start,
                                     double tolerance) {
  if (problem.device.effects != nullptr) return start;  // not linear in Iph, Is and 1/Rsh
  Descent descent(problem, start, tolerance);
  if (problem.objective == Objective::kMeasuredCurrent) {
    descent.Run();
    return descent.Parameters();
  }
  constexpr int kReweightings = 3;
  for (int round = 0; round < kReweightings; ++round) {
    descent.WeighForSolvedCurrent();
    descent.Run();
  }
  return descent.Parameters();
}

}  // namespace lyrefit
