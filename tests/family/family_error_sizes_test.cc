#include "lyrefit/family/family_errors.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "lyrefit/base/random.h"
#include "repeats.h"

namespace lyrefit {
namespace {

constexpr int kPoints = 30;  // per curve

FamilyErrorShape SyntheticFamilyShape(int curves) {
  FamilyErrorShape shape;
  shape.common.resize(curves * kPoints, 2);
  for (int c = 0; c < curves; ++c) {
    shape.first.push_back(c * kPoints);
    for (int k = 0; k < kPoints; ++k) {
      const double u = static_cast<double>(k) / (kPoints - 1), fall = std::exp(10 * (u - 1));
      shape.readings.current.push_back(1);
      shape.readings.voltage.push_back(3 * fall);
      shape.readings.path.push_back(5);
      shape.readings.position.push_back(u);
      shape.readings.chain.push_back(c);
      shape.common.row(c * kPoints + k) << 5 * (1 - fall), -0.3 * fall;
    }
  }
  shape.first.push_back(curves * kPoints);
  return shape;
}

const FamilyErrorSizes kSizes = {{0.004, 0.01, 0.002}, 0.004, 0.6};

Eigen::MatrixXd Covariance(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes) {
  const ErrorModel errors = MakeErrorModel(shape.readings, sizes.readings);
  const int rows = errors.size();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(rows, rows);
  for (int j = 0; j < rows; ++j) {
    for (int k = 0; k < rows; ++k) {
      if (errors.chain[j] != errors.chain[k]) continue;
      const double along = std::exp(-std::fabs(errors.position[j] - errors.position[k]));
      covariance(j, k) = errors.path[j] * errors.path[k] * along +
                         std::pow(sizes.irradiance, 2) * shape.common(j, 0) * shape.common(k, 0) +
                         std::pow(sizes.temperature_K, 2) * shape.common(j, 1) * shape.common(k, 1);
    }
    covariance(j, j) += errors.white[j] * errors.white[j];
  }
  return covariance;
}

Eigen::VectorXd Draw(const Eigen::MatrixXd& covariance, int seed) {
  RandomStream random(seed, 0);
  Eigen::VectorXd normal(covariance.rows());
  for (double& value : normal) value = random.Normal();
  return covariance.llt().matrixL() * normal;
}

TEST(FamilyErrors, LikelihoodAndProductAreThoseOfTheDenseCovariance) {
  const FamilyErrorShape shape = SyntheticFamilyShape(3);
  const Eigen::MatrixXd covariance = Covariance(shape, kSizes);
  const Eigen::VectorXd residual = Draw(covariance, 1);
  const double dense =
      -0.5 * (std::log(covariance.determinant()) + residual.dot(covariance.ldlt().solve(residual)));
  EXPECT_NEAR(LogLikelihood(shape, kSizes, residual), dense, 1e-8 * std::fabs(dense));
  const RowMatrix rows = residual;
  const RowMatrix product = CovarianceTimes(shape, kSizes, rows);
  EXPECT_LT((product - covariance * residual).norm(), 1e-12 * product.norm());
}

TEST(FamilyErrors, SizesAreFoundAndTheKindThatIsThereIsLikeliest) {
  SKIP_IF_SANITIZED();
  const FamilyErrorShape shape = SyntheticFamilyShape(60);
  const Eigen::MatrixXd covariance = Covariance(shape, kSizes);
  const Eigen::VectorXd residual = Draw(covariance, 2), other = Draw(covariance, 3);
  double before = -HUGE_VAL;
  FamilyErrorSizes found;
  for (const FamilyErrorKind kind :
       {FamilyErrorKind::kIndependent, FamilyErrorKind::kPath, FamilyErrorKind::kCurves}) {
    found = FindFamilyErrors(kind, shape, 5, 20, residual);
    const double held_out = LogLikelihood(shape, found, other);
    EXPECT_GT(held_out, before + 10);
    before = held_out;
  }
  EXPECT_NEAR(found.readings.current_A / kSizes.readings.current_A, 1, 0.1);
  EXPECT_NEAR(found.readings.voltage_V / kSizes.readings.voltage_V, 1, 0.2);
  EXPECT_NEAR(found.readings.path / kSizes.readings.path, 1, 0.2);
  EXPECT_NEAR(found.irradiance / kSizes.irradiance, 1, 0.35);
  EXPECT_NEAR(found.temperature_K / kSizes.temperature_K, 1, 0.35);
  EXPECT_EQ(FindFamilyErrors(FamilyErrorKind::kPath, shape, 5, 20, residual).temperature_K, 0);
}

}  // namespace
}  // namespace lyrefit
