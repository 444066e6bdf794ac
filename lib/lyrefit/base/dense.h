#pragma once

#include <Eigen/Core>

// Linear algebra on matrices of any size, compiled once. Eigen's products and decompositions are
// templates: every file that uses them compiles them again, at several seconds each. A call to one
// of the functions below costs microseconds. Sums and scalings compile fast, so callers write them
// with Eigen directly.
//
// Shapes: `a` has m rows and n columns; the other operands have the shapes that the formula needs.
// Nothing is checked.
namespace lyrefit {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Product a b.
Eigen::MatrixXd Times(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd Times(const Eigen::MatrixXd& a, const RowMatrix& b);
Eigen::MatrixXd Times(const RowMatrix& a, const Eigen::MatrixXd& b);
Eigen::VectorXd Times(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);

// Product a' b.
Eigen::MatrixXd TransposedTimes(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::VectorXd TransposedTimes(const Eigen::MatrixXd& a, const Eigen::VectorXd& x);
Eigen::VectorXd TransposedTimes(const RowMatrix& a, const Eigen::VectorXd& x);

// Product scale a a', m x m.
Eigen::MatrixXd TimesTransposed(const Eigen::MatrixXd& a, double scale = 1);

// Residual b - a x.
Eigen::VectorXd Residual(const Eigen::VectorXd& b, const Eigen::MatrixXd& a,
                         const Eigen::VectorXd& x);

// The x that minimises |a x - b|, by Householder QR with column pivoting. A matrix b gives one
// column of x for each column of b. Linearly dependent columns of `a` get the coefficient 0.
Eigen::VectorXd LeastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd LeastSquares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// Residual of the least-squares fit of the columns of `a` to y. The fit is repeated once on the
// residual, which removes the rounding error of the first fit.
Eigen::VectorXd WithoutColumns(const Eigen::MatrixXd& a, Eigen::VectorXd y);

// The n x m matrix whose product with b is LeastSquares(a, b). Returns false if the columns of `a`
// are linearly dependent.
bool PseudoInverse(const Eigen::MatrixXd& a, Eigen::MatrixXd* inverse);

// An orthonormal basis of the column space of `a`, m x rank, by QR with column pivoting.
Eigen::MatrixXd RankedBasis(const Eigen::MatrixXd& a);

// Projects each column of y onto the complement of orthonormal columns: y - basis basis' y.
void TakeOut(const Eigen::MatrixXd& basis, Eigen::VectorXd* y);
void TakeOut(const Eigen::MatrixXd& basis, Eigen::MatrixXd* y);

// Schur complement b' b - mixed' (a' a)^-1 mixed. The columns of `a` must be linearly independent;
// `mixed` has n rows and as many columns as b.
Eigen::MatrixXd SchurComplement(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                const Eigen::MatrixXd& mixed);

// Both solve a x = b for a square symmetric `a` and read its lower triangle only. SolvePositive
// uses Cholesky's decomposition and returns false unless `a` is positive definite. SolveSymmetric
// uses L D L' and takes any symmetric `a`.
bool SolvePositive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, Eigen::VectorXd* x);
Eigen::VectorXd SolveSymmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

// Cholesky factor: the lower triangular l with a = l l', for a positive definite `a`.
Eigen::MatrixXd LowerRoot(const Eigen::MatrixXd& a);

// Singular values in falling order, and their right singular vectors as columns (n x number of
// values).
struct RightSingular {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

// The min(m, n) singular values of `a`.
RightSingular FindRightSingular(const Eigen::MatrixXd& a);

// All n singular values of `a`; they are 0 beyond the first m if m < n. Computed from the
// triangular factor of a QR decomposition with column pivoting.
RightSingular FindAllRightSingular(const Eigen::MatrixXd& a);

}  // namespace lyrefit
