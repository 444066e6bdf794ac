#include "lyrefit/estimate/refine/error_model.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

constexpr int kRows = 60;

// Two chains, white noise that grows along the readings, and a path of varying size.
ErrorModel SyntheticErrors() {
  ErrorModel errors;
  for (int k = 0; k < kRows; ++k) {
    errors.white.push_back(0.3 + 0.01 * k);
    errors.path.push_back(1.5 - 0.02 * k);
    errors.position.push_back(0.05 * k + 0.002 * k * k);
    errors.chain.push_back(k < 25 ? 0 : 1);
  }
  return errors;
}

Eigen::MatrixXd Covariance(const ErrorModel& errors) {
  Eigen::MatrixXd covariance(kRows, kRows);
  for (int j = 0; j < kRows; ++j) {
    for (int k = 0; k < kRows; ++k) {
      const double along = std::exp(-std::fabs(errors.position[j] - errors.position[k]));
      covariance(j, k) =
          errors.chain[j] == errors.chain[k] ? errors.path[j] * errors.path[k] * along : 0.0;
    }
    covariance(j, j) += errors.white[j] * errors.white[j];
  }
  return covariance;
}

RowMatrix Draw(int columns) {
  RandomStream random(7, 0);
  RowMatrix rows(kRows, columns);
  for (double& value : rows.reshaped()) value = random.Normal();
  return rows;
}

TEST(ErrorModel, WhitensAsTheDenseCovarianceDoes) {
  const ErrorModel errors = SyntheticErrors();
  const Eigen::MatrixXd covariance = Covariance(errors);
  const RowMatrix rows = Draw(3);
  RowMatrix white = rows;
  const double logs = Whiten(errors, {}, white);
  const Eigen::MatrixXd products = rows.transpose() * covariance.ldlt().solve(rows);
  EXPECT_LT((white.transpose() * white - products).norm(), 1e-11 * products.norm());
  EXPECT_NEAR(logs, std::log(covariance.determinant()), 1e-9);
}

TEST(ErrorModel, LeavesOutReadingsAsIfTheyHadNotBeenTaken) {
  const ErrorModel errors = SyntheticErrors();
  std::vector<char> used(kRows, 1);
  std::vector<int> kept;
  for (int k = 0; k < kRows; ++k) {
    if (k % 7 == 3 || k == 25) used[k] = 0;
    if (used[k] != 0) kept.push_back(k);
  }
  const Eigen::MatrixXd covariance = Covariance(errors)(kept, kept);
  const RowMatrix rows = Draw(2);
  const Eigen::MatrixXd coarse = rows(kept, Eigen::all);
  RowMatrix white = rows;
  Whiten(errors, used, white);
  const Eigen::MatrixXd products = coarse.transpose() * covariance.ldlt().solve(coarse);
  EXPECT_LT((white.transpose() * white - products).norm(), 1e-11 * products.norm());
  for (int k = 0; k < kRows; ++k) EXPECT_EQ(white.row(k).norm() == 0, used[k] == 0) << k;
}

TEST(ErrorModel, TimesTheCovarianceIsTheDenseProduct) {
  const ErrorModel errors = SyntheticErrors();
  const RowMatrix rows = Draw(3);
  const RowMatrix dense = Covariance(errors) * rows;
  EXPECT_LT((CovarianceTimes(errors, rows) - dense).norm(), 1e-12 * dense.norm());
}

TEST(ErrorModel, WithoutAPathDividesByTheNoise) {
  ErrorModel errors = SyntheticErrors();
  errors.path.clear();
  RowMatrix rows = Draw(1);
  const RowMatrix before = rows;
  Whiten(errors, {}, rows);
  for (int k = 0; k < kRows; ++k) EXPECT_DOUBLE_EQ(rows(k, 0), before(k, 0) / errors.white[k]);
}

TEST(ErrorModel, RestrictedLikelihoodIsThatOfTheDenseCovariance) {
  const ErrorModel errors = SyntheticErrors();
  const Eigen::MatrixXd covariance = Covariance(errors), inverse = covariance.inverse();
  const RowMatrix rows = Draw(4);
  const Eigen::MatrixXd slopes = rows.leftCols(3);
  const Eigen::VectorXd residual = rows.col(3);
  const Eigen::MatrixXd information = slopes.transpose() * inverse * slopes;
  const Eigen::VectorXd rest =
      residual - slopes * information.ldlt().solve(slopes.transpose() * inverse * residual);
  const auto dense = [&](double scale) {  // with the covariance times `scale`
    return -0.5 * (kRows * std::log(scale) + std::log(covariance.determinant()) +
                   std::log(information.determinant()) - 3 * std::log(scale) +
                   rest.dot(inverse * rest) / scale);
  };
  ErrorModel larger = errors;
  for (double& white : larger.white) white *= 2;
  for (double& path : larger.path) path *= 2;
  const double gain = RestrictedLogLikelihood(larger, {}, residual, slopes) -
                      RestrictedLogLikelihood(errors, {}, residual, slopes);
  EXPECT_NEAR(gain, dense(4) - dense(1), 1e-9);
}

}  // namespace
}  // namespace lyrefit
