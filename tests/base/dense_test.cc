#include "lyrefit/base/dense.h"

#include <gtest/gtest.h>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd RandomMatrix(int rows, int columns) {
  RandomStream random(1, 0);
  MatrixXd a(rows, columns);
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) a(r, c) = random.Normal();
  }
  return a;
}

TEST(DenseTest, LeastSquaresLeavesNothingAlongTheColumns) {
  const MatrixXd a = RandomMatrix(60, 5);
  const VectorXd b = RandomMatrix(60, 6).col(5);
  const VectorXd rest = Residual(b, a, LeastSquares(a, b));
  EXPECT_LT(TransposedTimes(a, rest).norm(), 1e-12);
  EXPECT_GT(rest.norm(), 1);
  EXPECT_LT((WithoutColumns(a, b) - rest).norm(), 1e-12);
  VectorXd left = b;
  TakeOut(RankedBasis(a), &left);
  EXPECT_LT((left - rest).norm(), 1e-12);
  MatrixXd inverse;
  ASSERT_TRUE(PseudoInverse(a, &inverse));
  EXPECT_LT((Times(inverse, b) - LeastSquares(a, b)).norm(), 1e-12);
}

TEST(DenseTest, DependentColumnsAreNoticed) {
  MatrixXd a = RandomMatrix(60, 5);
  a.col(3) = a.col(0) + 2 * a.col(1);
  EXPECT_EQ(RankedBasis(a).cols(), 4);
  MatrixXd left = a;
  TakeOut(RankedBasis(a), &left);
  EXPECT_LT(left.norm(), 1e-12);
  MatrixXd inverse;
  EXPECT_FALSE(PseudoInverse(a, &inverse));
}

TEST(DenseTest, SingularValuesAreTheSameBothWays) {
  const MatrixXd a = RandomMatrix(40, 4);
  const RightSingular thin = FindRightSingular(a), all = FindAllRightSingular(a);
  EXPECT_LT((thin.values - all.values).norm(), 1e-12);
  const MatrixXd gram = TransposedTimes(a, a);
  for (const RightSingular* found : {&thin, &all}) {
    const MatrixXd scaled = found->vectors * found->values.asDiagonal();
    EXPECT_LT((TimesTransposed(scaled) - gram).norm(), 1e-11);
  }
  const RightSingular flat = FindAllRightSingular(a.topRows(3));
  EXPECT_EQ(flat.values.size(), 4);
  EXPECT_LT(flat.values[3], 1e-12);
}

TEST(DenseTest, SymmetricSystemsAreSolved) {
  const MatrixXd a = RandomMatrix(30, 4), b = RandomMatrix(30, 6).rightCols(2);
  const MatrixXd gram = TransposedTimes(a, a);
  const VectorXd y = gram.col(0) - 3 * gram.col(2);
  VectorXd x;
  ASSERT_TRUE(SolvePositive(gram, y, &x));
  EXPECT_LT((x - VectorXd::Unit(4, 0) + 3 * VectorXd::Unit(4, 2)).norm(), 1e-12);
  EXPECT_LT((SolveSymmetric(gram, y) - x).norm(), 1e-12);
  EXPECT_FALSE(SolvePositive(-gram, y, &x));
  // b'b after projection of `b` off the columns of `a`.
  MatrixXd rest = b;
  TakeOut(RankedBasis(a), &rest);
  const MatrixXd schur = SchurComplement(a, b, TransposedTimes(a, b));
  EXPECT_LT((schur - TransposedTimes(rest, rest)).norm(), 1e-11);
}

}  // namespace
}  // namespace lyrefit
