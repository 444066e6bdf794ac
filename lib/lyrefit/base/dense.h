#pragma once

#include <Eigen/Core>

// Linear algebra on matrices of any size, compiled once. Eigen's decompositions and products are
// templates that every file using them compiles anew, at several seconds each; what takes
// microseconds to call stands here. Sums and scalings are best written with Eigen where they are
// needed.
//
// Shapes: `a` has m rows and n columns, vectors and matrices fit it as the formula says. Nothing is
// checked.
namespace lyrefit {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// a b
Eigen::MatrixXd Times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd Times(const Eigen::MatrixXd& a, const RowMatrix& b);
Eigen::MatrixXd Times(const RowMatrix& a, const Eigen::MatrixXd& b);
Eigen::VectorXd Times(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);
Eigen::MatrixXf Times(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b);
Eigen::VectorXf Times(const Eigen::MatrixXf& a, const Eigen::VectorXf& x);

// a' b
Eigen::MatrixXd TransposedTimes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd TransposedTimes(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);
Eigen::VectorXd TransposedTimes(const RowMatrix& a, const Eigen::VectorXd& x);
Eigen::MatrixXf TransposedTimes(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b);
Eigen::VectorXf TransposedTimes(const Eigen::MatrixXf& a, const Eigen::VectorXf& x);

// scale a a', m x m.
Eigen::MatrixXd TimesTransposed(const Eigen::MatrixXd& a, double scale = 1);

// b - a x
Eigen::VectorXd Residual(const Eigen::VectorXd& b, const Eigen::MatrixXd& a,
                         const Eigen::VectorXd& x);

// The x that minimises |a x - b|, by Householder reflections with column pivoting; the matrix has
// one for every column of b. Columns that depend on others get 0.
Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// What is left of y once the columns of `a` are fitted to it, and fitted once more to take the
// first fit's rounding out.
Eigen::VectorXd WithoutColumns(const Eigen::MatrixXd& a, Eigen::VectorXd y);

// The n x m matrix whose product with b is LeastSquares(a, b); false if the columns of `a` depend
// on each other.
bool PseudoInverse(const Eigen::MatrixXd& a, Eigen::MatrixXd* inverse);

// Orthonormal columns that span those of `a`, as many as the rank, by column pivoting.
Eigen::MatrixXd RankedBasis(const Eigen::MatrixXd& a);

// The columns of `a`, which are independent by far, combined so that b' diag(weight) b = 1.
Eigen::MatrixXf OrthonormalUnder(const Eigen::MatrixXf& a, const Eigen::VectorXf& weight);

// Takes the part along orthonormal columns out: y - basis basis' y, of each column of y.
void TakeOut(const Eigen::MatrixXd& basis, Eigen::VectorXd* y);
void TakeOut(const Eigen::MatrixXd& basis, Eigen::MatrixXd* y);

// b' b - mixed' (a' a)^-1 mixed, the columns of `a` independent and `mixed` n x columns of b.
Eigen::MatrixXd SchurComplement(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const Eigen::MatrixXd& mixed);

// x with a x = b for a square symmetric `a`, of which the lower triangle is read. By Cholesky's
// decomposition: false unless `a` is positive definite; by that with a diagonal: for any.
bool SolvePositive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::VectorXd* x);
Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// The lower triangle l of a positive definite `a` = l l'.
Eigen::MatrixXd LowerRoot(const Eigen::MatrixXd& a);

// Singular values, falling, and the right singular vectors that belong to them, n x their number.
struct RightSingular {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// There are min(m, n) of them.
RightSingular FindRightSingular(const Eigen::MatrixXd& a);

// There are n of them, 0 where m < n: those of the triangle that column-pivoted reflections leave.
RightSingular FindAllRightSingular(const Eigen::MatrixXd& a);

}  // namespace lyrefit
