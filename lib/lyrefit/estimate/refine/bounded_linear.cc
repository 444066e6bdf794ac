#include "lyrefit/estimate/refine/bounded_linear.h"

#include <Eigen/Cholesky>
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

}  // namespace lyrefit
