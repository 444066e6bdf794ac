#include "lyrefit/estimate/refine/separable.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdio>
#include <utility>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/bounded_linear.h"

namespace lyrefit {
namespace {

constexpr int kIdealities = 5;

// Even steps in 1/n between the bounds of a diode's n: 1, 1.14, 1.33, 1.6, 2 for [1, 2].
std::vector<double> IdealityGrid(double lower, double upper) {
  if (lower == upper) return {lower};
  std::vector<double> grid;
  const double low = std::max(lower, 0.1);
  for (int k = 0; k < kIdealities; ++k) {
    const double t = static_cast<double>(k) / (kIdealities - 1);
    grid.push_back(1 / ((1 - t) / low + t / upper));
  }
  return grid;
}

std::vector<double> SeriesResistanceGrid(const RefineProblem& problem, double hint) {
  const double lower = problem.lower[kRs];
  const double upper = problem.upper[kRs];
  if (lower == upper) return {lower};
  std::vector<double> grid = {0};
  for (double part = 0.5; part > 0.01; part /= 2) grid.push_back(part * problem.resistance_scale());
  for (const double part : {1.0, 0.5, 0.25}) {
    if (hint > 0) grid.push_back(part * hint);
  }
  for (double& rs : grid) rs = std::min(std::max(rs, lower), upper);
  std::sort(grid.begin(), grid.end());
  grid.erase(std::unique(grid.begin(), grid.end()), grid.end());
  return grid;
}

// The n of all diodes' grids.
std::vector<double> Idealities(const RefineProblem& problem) {
  std::vector<double> idealities;
  for (int d = 0; d < DiodeCount(problem.device); ++d) {
    const int n = IdealityIndex(d);
    for (const double value : IdealityGrid(problem.lower[n], problem.upper[n])) {
      if (std::find(idealities.begin(), idealities.end(), value) == idealities.end()) {
        idealities.push_back(value);
      }
    }
  }
  return idealities;
}

// The columns of all n at one Rs; every combination of n uses their Gram matrix.
struct GridColumns {
  double rs;
  LinearPart linear;
  Eigen::MatrixXd gram;
  Eigen::VectorXd atb;
};

GridColumns ColumnsAt(const RefineProblem& problem, const std::vector<double>& idealities,
                      double rs) {
  GridColumns at;
  at.rs = rs;
  at.linear = MakeLinearColumns(problem, problem.weights, rs, idealities);
  at.gram = at.linear.columns.transpose() * at.linear.columns;
  at.atb = at.linear.columns.transpose() * at.linear.target;
  return at;
}

// The least-squares solution of the linear unknowns for the `chosen` n.
SeparableStart SolveFor(const RefineProblem& problem, const std::vector<double>& idealities,
                        const GridColumns& at, const std::vector<int>& chosen) {
  const int size = 2 + static_cast<int>(chosen.size());
  std::vector<int> column = {0, 1};
  for (const int k : chosen) column.push_back(2 + k);
  SmallMatrix gram(size, size);
  SmallVector atb(size), lower, upper;
  LinearPart part;
  part.scale.resize(size);
  std::vector<double> n;
  n.reserve(chosen.size());
  for (int a = 0; a < size; ++a) {
    atb[a] = at.atb[column[a]];
    part.scale[a] = at.linear.scale[column[a]];
    for (int b = 0; b < size; ++b) gram(a, b) = at.gram(column[a], column[b]);
  }
  for (const int k : chosen) n.push_back(idealities[k]);
  LinearBounds(problem, part.scale, &lower, &upper);
  part.x = SolveBoundedLinear(gram, atb, lower, upper);
  SeparableStart start;
  start.p = ToParameters(problem, part, at.rs, n);
  start.mean_square = MeanSquare(problem, start.p);
  return start;
}

bool HasRangeOfTheLast(const RefineProblem& problem, int diode) {
  const int n = IdealityIndex(diode);
  const int previous = IdealityIndex(diode - 1);
  return !problem.fixed(n) && problem.lower[n] == problem.lower[previous] &&
         problem.upper[n] == problem.upper[previous];
}

// Ascending combinations of those n of the grid that every diode's bounds allow.
void Combine(const RefineProblem& problem, const std::vector<double>& idealities,
             const GridColumns& at, std::vector<int>* chosen, std::vector<SeparableStart>* starts) {
  const int diode = static_cast<int>(chosen->size());
  if (diode == DiodeCount(problem.device)) {
    starts->push_back(SolveFor(problem, idealities, at, *chosen));
    return;
  }
  const int n = IdealityIndex(diode);
  const bool rising = diode > 0 && HasRangeOfTheLast(problem, diode);
  for (int k = rising ? chosen->back() + 1 : 0; k < static_cast<int>(idealities.size()); ++k) {
    if (idealities[k] < problem.lower[n] || idealities[k] > problem.upper[n]) continue;
    chosen->push_back(k);
    Combine(problem, idealities, at, chosen, starts);
    chosen->pop_back();
  }
}

std::string Origin(int diodes, const std::vector<double>& p) {
  char text[32];
  std::string origin = "grid n = ";
  for (int d = 0; d < diodes; ++d) {
    std::snprintf(text, sizeof text, "%s%.3g", d > 0 ? ", " : "", p[IdealityIndex(d)]);
    origin += text;
  }
  std::snprintf(text, sizeof text, "; Rs = %.3g ohm", p[kRs]);
  return origin + text;
}

// The starts of the lowest mean square, each with a different set of n.
std::vector<SeparableStart> Best(std::vector<SeparableStart> starts, int diodes, int count) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const auto& a, const auto& b) { return a.mean_square < b.mean_square; });
  std::vector<SeparableStart> best;
  for (const SeparableStart& start : starts) {
    if (static_cast<int>(best.size()) == count) break;
    const bool seen = std::any_of(best.begin(), best.end(), [&](const SeparableStart& taken) {
      for (int d = 0; d < diodes; ++d) {
        if (taken.p[IdealityIndex(d)] != start.p[IdealityIndex(d)]) return false;
      }
      return true;
    });
    if (seen) continue;
    best.push_back(start);
    best.back().origin = Origin(diodes, start.p);
  }
  return best;
}

}  // namespace

// Tries all combinations of n at each Rs.
std::vector<SeparableStart> SeparableStarts(const RefineProblem& problem, double rs_hint,
                                            int count) {
  if (problem.device.effects != nullptr) return {};
  const std::vector<double> idealities = Idealities(problem);
  std::vector<SeparableStart> starts;
  for (const double rs : SeriesResistanceGrid(problem, rs_hint)) {
    const GridColumns columns = ColumnsAt(problem, idealities, rs);
    std::vector<int> chosen;
    Combine(problem, idealities, columns, &chosen, &starts);
  }
  return Best(std::move(starts), DiodeCount(problem.device), count);
}

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
