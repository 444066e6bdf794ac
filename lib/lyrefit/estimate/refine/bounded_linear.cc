#include "lyrefit/estimate/refine/bounded_linear.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

// Marks the unknowns that are free; the others are at an active bound.
template <class Vector>
using Flags = Eigen::Matrix<bool, Eigen::Dynamic, 1, 0, Vector::MaxRowsAtCompileTime, 1>;

// The problem by its normal equations.
struct NormalEquations {
  const SmallMatrix& gram;
  const SmallVector& atb;

  // The minimum over the free unknowns.
  SmallVector Solve(const Flags<SmallVector>& free, SmallVector x) const {
    int index[kMostLinear];
    int count = 0;
    for (int i = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      x[i] = 0;
      index[count++] = i;
    }
    const SmallVector shifted = atb - gram * x;
    SmallMatrix g(count, count);
    SmallVector rhs(count);
    for (int a = 0; a < count; ++a) {
      rhs[a] = shifted[index[a]];
      for (int b = 0; b < count; ++b) g(a, b) = gram(index[a], index[b]);
    }
    const SmallVector solution = g.ldlt().solve(rhs);
    for (int a = 0; a < count; ++a) x[index[a]] = solution[a];
    return x;
  }
  // Half the gradient of the objective, with the sign reversed.
  SmallVector Pull(const SmallVector& x) const { return atb - gram * x; }
  double Length(int i) const { return std::sqrt(gram(i, i)); }
  double Rounding() const { return 1e-12; }  // of a pull over the length of its column
};

// The problem by its columns.
struct Columns {
  const Eigen::MatrixXd& a;
  const Eigen::VectorXd& b;

  Eigen::VectorXd Solve(const Flags<Eigen::VectorXd>& free, Eigen::VectorXd x) const {
    Eigen::MatrixXd columns(a.rows(), free.count());
    for (int i = 0, next = 0; i < free.size(); ++i) {
      if (!free[i]) continue;
      x[i] = 0;
      columns.col(next++) = a.col(i);
    }
    const Eigen::VectorXd rest = x.isZero(0) ? b : Residual(b, a, x);
    const Eigen::VectorXd solution = LeastSquares(columns, rest);
    for (int i = 0, next = 0; i < free.size(); ++i) {
      if (free[i]) x[i] = solution[next++];
    }
    return x;
  }
  Eigen::VectorXd Pull(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd y = Residual(b, a, x);
    Eigen::VectorXd pull(x.size());
    for (int i = 0; i < pull.size(); ++i) pull[i] = a.col(i).dot(y);
    return pull;
  }
  double Length(int i) const { return a.col(i).norm(); }
  double Rounding() const { return 1e-15 * b.norm(); }
};

// Steps from x to `target`; stops at the first bound on the way and holds that unknown there. True
// if no bound was met.
template <class Vector>
bool StepTowards(const Vector& target, const Vector& lower, const Vector& upper, Vector* x,
                 Flags<Vector>* free) {
  double reach = 1;
  double end = 0;
  int first = -1;
  for (int i = 0; i < target.size(); ++i) {
    const bool below = target[i] <= lower[i];
    if (!(*free)[i] || (!below && target[i] < upper[i])) continue;
    const double bound = below ? lower[i] : upper[i];
    const double fraction = (*x)[i] == bound ? 0 : (bound - (*x)[i]) / (target[i] - (*x)[i]);
    if (first >= 0 && fraction >= reach) continue;
    reach = fraction;
    end = bound;
    first = i;
  }
  for (int i = 0; i < target.size(); ++i) {
    if ((*free)[i]) (*x)[i] += reach * (target[i] - (*x)[i]);
  }
  if (first < 0) return true;
  (*x)[first] = end;
  (*free)[first] = false;
  return false;
}

// The active unknown along whose column the objective falls most steeply when it leaves its bound;
// -1 if none exceeds rounding.
template <class Problem, class Vector>
int MostWanted(const Problem& problem, const Vector& lower, const Vector& upper, const Vector& x,
               const Flags<Vector>& free) {
  const Vector pull = problem.Pull(x);
  int best = -1;
  double strongest = problem.Rounding();
  for (int i = 0; i < x.size(); ++i) {
    if (free[i] || !(lower[i] < upper[i])) continue;
    const double length = problem.Length(i);
    const double inward = (x[i] <= lower[i] ? pull[i] : -pull[i]) / (length > 0 ? length : 1);
    if (inward <= strongest) continue;
    strongest = inward;
    best = i;
  }
  return best;
}

template <class Problem, class Vector>
Vector SolveActiveSets(const Problem& problem, const Vector& lower, const Vector& upper, Vector x,
                       Flags<Vector> free) {
  for (int round = 0; round <= 10 * x.size(); ++round) {
    while (free.any()) {
      const Vector target = problem.Solve(free, x);
      if (!target.allFinite()) return x;
      if (StepTowards(target, lower, upper, &x, &free)) break;
    }
    const int best = MostWanted(problem, lower, upper, x, free);
    if (best < 0) break;
    free[best] = true;
  }
  return x;
}

}  // namespace

SmallVector SolveBoundedLinear(const SmallMatrix& gram, const SmallVector& atb,
                               const SmallVector& lower, const SmallVector& upper) {
  const Flags<SmallVector> none = Flags<SmallVector>::Constant(atb.size(), false);
  return SolveActiveSets(NormalEquations{gram, atb}, lower, upper, lower, none);
}

Eigen::VectorXd SolveBoundedColumns(const Eigen::MatrixXd& a, const Eigen::VectorXd& b,
                                    const Eigen::VectorXd& lower, const Eigen::VectorXd& upper,
                                    Eigen::VectorXd x) {
  const Flags<Eigen::VectorXd> all = lower.array() < upper.array();
  return SolveActiveSets(Columns{a, b}, lower, upper, std::move(x), all);
}

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
