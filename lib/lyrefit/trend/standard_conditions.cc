#include "lyrefit/trend/standard_conditions.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

constexpr double kHuberAt = 1.5;  // standard deviations
constexpr double kDimmest = 0.1;  // below, the features stay what they are there
constexpr std::size_t kLeastValues = 30;

double WeightOf(double residual, double sigma) {
  return HuberWeight(std::fabs(residual), kHuberAt * sigma);
}

// Ends of the blocks in `values`, which are ordered by them.
std::vector<std::size_t> BlockEnds(const std::vector<ConditionedValue>& values) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i == values.size() || values[i].block != values[i - 1].block) ends.push_back(i);
  }
  return ends;
}

// Subtracts the weighted mean of each block from features and value.
Eigen::MatrixXd Centred(const std::vector<ConditionedValue>& values,
                        const std::vector<std::size_t>& ends, const Eigen::VectorXd& weights) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(values.size()), kConditionFeatures + 1);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const ConditionedValue& one = values[static_cast<std::size_t>(i)];
    for (int f = 0; f < kConditionFeatures; ++f) rows(i, f) = one.features[f];
    rows(i, kConditionFeatures) = one.value;
  }
  Eigen::Index begin = 0;
  for (const std::size_t end : ends) {
    const Eigen::Index size = static_cast<Eigen::Index>(end) - begin;
    const Eigen::VectorXd own = weights.segment(begin, size);
    const Eigen::RowVectorXd mean =
        (own.transpose() * rows.middleRows(begin, size)) / std::max(own.sum(), 1e-12);
    rows.middleRows(begin, size).rowwise() -= mean;
    begin = static_cast<Eigen::Index>(end);
  }
  return rows;
}

}  // namespace

Features FeaturesAt(double light, double temperature_C) {
  const double ln = std::log(std::max(light, kDimmest));
  const double warm = (temperature_C - 25) / 10;
  return {warm, ln, ln * ln, warm * ln, warm * warm};
}

Features SkyFeaturesAt(double temperature_C, double clearness, double height) {
  return {(temperature_C - 25) / 10, 1 - clearness, clearness * std::pow(1 - height, 4)};
}

double Departure(const Features& coefficients, const Features& features) {
  double sum = 0;
  for (int f = 0; f < kConditionFeatures; ++f) sum += coefficients[f] * features[f];
  return sum;
}

Features FitWithinBlocks(const std::vector<ConditionedValue>& values) {
  Features out{};
  const std::vector<std::size_t> ends = BlockEnds(values);
  if (values.size() < kLeastValues || values.size() < 3 * ends.size()) return out;
  constexpr int kRounds = 8;
  constexpr double kRank = 1e-4;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(values.size()));
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::MatrixXd rows = Centred(values, ends, weights);
    const Eigen::MatrixXd x = weights.cwiseSqrt().asDiagonal() * rows.leftCols(kConditionFeatures);
    const Eigen::VectorXd y = weights.cwiseSqrt().cwiseProduct(rows.rightCols(1).col(0));
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(kRank);
    const Eigen::VectorXd found = solver.compute(x).solve(y);
    const Eigen::VectorXd residuals =
        rows.rightCols(1).col(0) - rows.leftCols(kConditionFeatures) * found;
    for (int f = 0; f < kConditionFeatures; ++f) out[f] = found[f];
    const double sigma = RobustScale({residuals.begin(), residuals.end()});
    if (!(sigma > 0)) break;
    for (Eigen::Index i = 0; i < weights.size(); ++i) weights[i] = WeightOf(residuals[i], sigma);
  }
  return out;
}

double BlockMean(const std::vector<ConditionedValue>& values, const Features& coefficients) {
  std::vector<double> plain;
  plain.reserve(values.size());
  for (const ConditionedValue& one : values) {
    plain.push_back(one.value - Departure(coefficients, one.features));
  }
  double mean = Median(plain);
  if (plain.size() < 3) return mean;
  std::vector<double> off = plain;
  for (double& value : off) value -= mean;
  const double sigma = RobustScale(std::move(off));
  if (!(sigma > 0)) return mean;
  constexpr int kRounds = 10;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0, weight = 0;
    for (const double value : plain) {
      const double w = WeightOf(value - mean, sigma);
      sum += w * value;
      weight += w;
    }
    mean = sum / weight;
  }
  return mean;
}

}  // namespace lyrefit
