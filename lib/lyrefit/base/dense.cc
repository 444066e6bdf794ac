// Optimized fully: its matrices are those of every estimate.
#include "lyrefit/base/dense.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

namespace lyrefit {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd Times(const MatrixXd& a, const MatrixXd& b) { return a * b; }
MatrixXd Times(const MatrixXd& a, const RowMatrix& b) { return a * b; }
MatrixXd Times(const RowMatrix& a, const MatrixXd& b) { return a * b; }
VectorXd Times(const MatrixXd& a, const VectorXd& x) { return a * x; }

MatrixXd TransposedTimes(const MatrixXd& a, const MatrixXd& b) { return a.transpose() * b; }
VectorXd TransposedTimes(const MatrixXd& a, const VectorXd& x) { return a.transpose() * x; }
VectorXd TransposedTimes(const RowMatrix& a, const VectorXd& x) { return a.transpose() * x; }

MatrixXd TimesTransposed(const MatrixXd& a, double scale) { return scale * a * a.transpose(); }

VectorXd Residual(const VectorXd& b, const MatrixXd& a, const VectorXd& x) { return b - a * x; }

VectorXd LeastSquares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

MatrixXd LeastSquares(const MatrixXd& a, const MatrixXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

VectorXd WithoutColumns(const MatrixXd& a, VectorXd y) {
  if (a.cols() == 0) return y;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  for (int round = 0; round < 2; ++round) y -= a * VectorXd(qr.solve(y));
  return y;
}

bool PseudoInverse(const MatrixXd& a, MatrixXd* inverse) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  if (qr.rank() != a.cols()) return false;
  const MatrixXd one = MatrixXd::Identity(a.rows(), a.rows());
  *inverse = qr.solve(one);
  return true;
}

MatrixXd RankedBasis(const MatrixXd& a) {
  if (a.cols() == 0) return a;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  return qr.householderQ() * MatrixXd::Identity(a.rows(), qr.rank());
}

void TakeOut(const MatrixXd& basis, VectorXd* y) { *y -= basis * TransposedTimes(basis, *y); }
void TakeOut(const MatrixXd& basis, MatrixXd* y) { *y -= basis * TransposedTimes(basis, *y); }

MatrixXd SchurComplement(const MatrixXd& a, const MatrixXd& b, const MatrixXd& mixed) {
  const Eigen::HouseholderQR<MatrixXd> qr(a);
  const MatrixXd r = qr.matrixQR().topRows(a.cols());
  const MatrixXd w = r.triangularView<Eigen::Upper>().transpose().solve(mixed);
  return b.transpose() * b - w.transpose() * w;
}

bool SolvePositive(const MatrixXd& a, const VectorXd& b, VectorXd* x) {
  const Eigen::LLT<MatrixXd> llt(a);
  if (llt.info() != Eigen::Success) return false;
  *x = llt.solve(b);
  return true;
}

VectorXd SolveSymmetric(const MatrixXd& a, const VectorXd& b) { return a.ldlt().solve(b); }

MatrixXd LowerRoot(const MatrixXd& a) { return a.llt().matrixL(); }

RightSingular FindRightSingular(const MatrixXd& a) {
  const Eigen::JacobiSVD<MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixV()};
}

RightSingular FindAllRightSingular(const MatrixXd& a) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  const Eigen::Index rows = std::min(a.rows(), a.cols());
  MatrixXd triangle = MatrixXd::Zero(a.cols(), a.cols());
  triangle.topRows(rows) = qr.matrixR().topRows(rows).triangularView<Eigen::Upper>();
  const MatrixXd square = triangle * qr.colsPermutation().transpose();
  const Eigen::JacobiSVD<MatrixXd> svd(square, Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

}  // namespace lyrefit
