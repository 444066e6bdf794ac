#include "lyrefit/family/family_error_sizes.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/estimate/refine/error_sizes.h"

namespace lyrefit {
namespace {

// Center of weak priors: a per cent of light and a kelvin, with a factor of 20 either way.
constexpr double kUsualIrradiance = 0.01;
constexpr double kUsualTemperature_K = 1;
constexpr double kWidth = 3;

RowMatrix CommonErrors(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes) {
  RowMatrix common = shape.common;
  common.col(0) *= sizes.irradiance;
  common.col(1) *= sizes.temperature_K;
  return common;
}

FamilyErrorSizes SizesAt(FamilyErrorKind kind, const std::vector<double>& logs) {
  FamilyErrorSizes sizes;
  sizes.readings.current_A = std::exp(logs[0]);
  if (kind == FamilyErrorKind::kIndependent) return sizes;
  sizes.readings.voltage_V = std::exp(logs[1]);
  sizes.readings.path = std::exp(logs[2]);
  if (kind == FamilyErrorKind::kPath) return sizes;
  sizes.irradiance = std::exp(logs[3]);
  sizes.temperature_K = std::exp(logs[4]);
  return sizes;
}

}  // namespace

FamilyErrorSizes FindFamilyErrors(FamilyErrorKind kind, const FamilyErrorShape& shape, double isc_A,
                                  double voc_V, const Eigen::VectorXd& residual) {
  const ErrorPrior prior = UsualErrors(isc_A, voc_V);
  std::vector<double> center = {std::log(prior.center.current_A), std::log(prior.center.voltage_V),
                                std::log(prior.center.path), std::log(kUsualIrradiance),
                                std::log(kUsualTemperature_K)};
  const std::vector<double> width = {prior.width.current_A, prior.width.voltage_V, prior.width.path,
                                     kWidth, kWidth};
  center.resize(kind == FamilyErrorKind::kIndependent ? 1 : kind == FamilyErrorKind::kPath ? 3 : 5);
  const auto value = [&](const std::vector<double>& at) {
    double sum = LogLikelihood(shape, SizesAt(kind, at), residual);
    for (std::size_t i = 0; i < at.size(); ++i) {
      sum -= 0.5 * std::pow((at[i] - center[i]) / width[i], 2);
    }
    return std::isnan(sum) ? -HUGE_VAL : sum;
  };
  constexpr int kMostSteps = 30;
  std::vector<double> best = center;
  for (const double part : {1.0, 0.03}) {  // of the usual sizes: tracers' readings, simulated ones
    std::vector<double> start = center;
    for (double& one : start) one += std::log(part);
    std::vector<double> end = NewtonAscent(value, std::move(start), kMostSteps);
    if (value(end) > value(best)) best = std::move(end);
  }
  return SizesAt(kind, best);
}

double LogLikelihood(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                     const Eigen::VectorXd& residual) {
  const Eigen::Index shared = shape.common.cols();
  RowMatrix rows(residual.size(), 1 + shared);
  rows.col(0) = residual;
  rows.rightCols(shared) = CommonErrors(shape, sizes);
  double sum = Whiten(MakeErrorModel(shape.readings, sizes.readings), {}, rows);
  for (std::size_t c = 0; c + 1 < shape.first.size(); ++c) {
    const Eigen::MatrixXd block =
        rows.middleRows(shape.first[c], shape.first[c + 1] - shape.first[c]);
    const Eigen::MatrixXd all = TransposedTimes(block, block);
    // Whitened readings have the covariance 1 + common common': Woodbury's formula.
    const double a = all(1, 1) + 1, b = all(2, 2) + 1, mixed = all(1, 2);
    const double determinant = a * b - mixed * mixed, x = all(0, 1), y = all(0, 2);
    sum += std::log(determinant) + all(0, 0) -
           (b * x * x - 2 * mixed * x * y + a * y * y) / determinant;
  }
  return -0.5 * sum;
}

RowMatrix CovarianceTimes(const FamilyErrorShape& shape, const FamilyErrorSizes& sizes,
                          const RowMatrix& rows) {
  RowMatrix product = CovarianceTimes(MakeErrorModel(shape.readings, sizes.readings), rows);
  const RowMatrix common = CommonErrors(shape, sizes);
  for (std::size_t c = 0; c + 1 < shape.first.size(); ++c) {
    const int first = shape.first[c], count = shape.first[c + 1] - first;
    const Eigen::MatrixXd errors = common.middleRows(first, count);
    const Eigen::MatrixXd block = rows.middleRows(first, count);
    product.middleRows(first, count) += Times(errors, TransposedTimes(errors, block));
  }
  return product;
}

}  // namespace lyrefit
