#include "lyrefit/diagnose/null_statistics.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/base/dense.h"

namespace lyrefit {
namespace {

using Eigen::MatrixXf;
using Eigen::VectorXf;

// Number of null samples that are computed together, so that the matrices stay in the cache.
constexpr int kLot = 100;

// Matrices of all candidates side by side, so that one product serves all of them. Single precision
// suffices for random noise.
struct Stack {
  std::vector<const CandidateEffect*> candidates;  // the testable ones
  std::vector<int> first;  // first column of each; last entry: number of columns
  MatrixXf basis;
  MatrixXf directions;
  VectorXf used;  // 1 or 0

  // Largest score of a candidate, from the scores `along` of all directions. `at` receives its
  // column.
  template <class Column>
  float Largest(std::size_t candidate, const Column& along, int* at) const {
    const auto own = along.segment(first[candidate], first[candidate + 1] - first[candidate]);
    const float size =
        candidates[candidate]->two_sided ? own.cwiseAbs().maxCoeff(at) : own.maxCoeff(at);
    *at += first[candidate];
    return std::max(size, 0.0F);
  }
  bool IsOutliers(std::size_t candidate) const { return first[candidate + 1] == first[candidate]; }
};

Stack MakeStack(const WeightedData& weighted, const Prepared& prepared) {
  Stack stack;
  stack.first = {0};
  for (const CandidateEffect& candidate : prepared.candidates) {
    if (!candidate.score.testable) continue;
    stack.candidates.push_back(&candidate);
    stack.first.push_back(stack.first.back() + static_cast<int>(candidate.directions.cols()));
  }
  stack.basis = prepared.linear.basis.cast<float>();
  stack.directions.resize(stack.basis.rows(), stack.first.back());
  for (std::size_t c = 0; c < stack.candidates.size(); ++c) {
    if (stack.IsOutliers(c)) continue;
    stack.directions.middleCols(stack.first[c], stack.first[c + 1] - stack.first[c]) =
        stack.candidates[c]->directions;
  }
  stack.used.resize(stack.basis.rows());
  for (int k = 0; k < stack.used.size(); ++k) stack.used[k] = weighted.used[k] != 0 ? 1.0F : 0.0F;
  return stack;
}

// A batch of null samples after the noise is re-estimated and the readings are reweighted.
struct Reweighted {
  MatrixXf weights;             // squared, one column per null sample
  MatrixXf rest;                // noise projected off the law's parameters, times the weights
  std::vector<MatrixXf> basis;  // of the law's parameters, times the weights
  VectorXf sums;                // weighted sums of squares of the projected noise
  VectorXf outliers;            // largest studentized residual of a single reading
};

void Reweight(const WeightedData& weighted, const Stack& stack, const NoiseEstimator& estimator,
              const VectorXf& noise, int d, Reweighted* lot) {
  const int count = static_cast<int>(noise.size());
  const VectorXf left = noise - Times(stack.basis, TransposedTimes(stack.basis, noise));
  std::vector<double> residual(count);
  for (int k = 0; k < count; ++k) residual[k] = left[k] * weighted.sigma[k];
  const std::vector<double> sigma = estimator.Estimate(residual).sigma;
  auto weight = lot->weights.col(d);
  for (int k = 0; k < count; ++k) {
    const double ratio = weighted.sigma[k] / sigma[k];
    weight[k] = stack.used[k] * static_cast<float>(ratio * ratio);
  }
  const MatrixXf basis = OrthonormalUnder(stack.basis, weight);
  lot->basis[d] = weight.asDiagonal() * basis;
  const VectorXf rest = noise - Times(basis, TransposedTimes(lot->basis[d], noise));
  lot->rest.col(d) = weight.cwiseProduct(rest);
  lot->sums[d] = rest.dot(lot->rest.col(d));
  const VectorXf room = (1 - weight.array() * basis.rowwise().squaredNorm().array()).max(1e-9F);
  lot->outliers[d] = std::sqrt((weight.array() * rest.array().square() / room.array()).maxCoeff());
}

// Largest score of a candidate in null sample `d`. `along`: scores of all directions, without a
// correction of their lengths by the part that the law absorbs. The correction is computed for the
// largest only: the weights vary little, so it is nearly equal for all directions.
float LargestReweighted(const Stack& stack, std::size_t candidate, const Reweighted& lot, int d,
                        const VectorXf& along, const VectorXf& lengths) {
  if (stack.IsOutliers(candidate)) return lot.outliers[d];
  int at = 0;
  const float size = stack.Largest(candidate, along, &at);
  const float absorbed =
      TransposedTimes(lot.basis[d], VectorXf(stack.directions.col(at))).squaredNorm();
  return size * std::sqrt(lengths[at] / std::max(lengths[at] - absorbed, 1e-12F));
}

}  // namespace

MatrixXf SimulateNullDistribution(const WeightedData& weighted, const Prepared& prepared,
                                  const Eigen::Ref<const MatrixXf>& draws) {
  const Stack stack = MakeStack(weighted, prepared);
  const VectorXf room = (1 - stack.basis.rowwise().squaredNorm().array()).max(1e-9F).rsqrt();
  MatrixXf statistics = MatrixXf::Zero(draws.cols(), static_cast<int>(stack.candidates.size()));
  for (int first = 0; first < draws.cols() && !weighted.progress.Stopped(); first += kLot) {
    const int lot = std::min(kLot, static_cast<int>(draws.cols()) - first);
    const MatrixXf noise = stack.used.asDiagonal() * draws.middleCols(first, lot);
    const MatrixXf left = noise - Times(stack.basis, TransposedTimes(stack.basis, noise));
    const MatrixXf along = TransposedTimes(stack.directions, noise);  // orthogonal to the basis
    for (int d = 0; d < lot; ++d) {
      const float sum = left.col(d).squaredNorm();
      for (std::size_t c = 0; c < stack.candidates.size(); ++c) {
        int at = 0;
        const float best = stack.IsOutliers(c)
                               ? left.col(d).cwiseProduct(room).cwiseAbs().maxCoeff()
                               : stack.Largest(c, along.col(d), &at);
        statistics(first + d, static_cast<int>(c)) =
            static_cast<float>(Statistic(best, sum, prepared.degrees, weighted.least_variance));
      }
    }
  }
  return statistics;
}

MatrixXf SimulateRefits(const WeightedData& weighted, const Prepared& prepared,
                        const NoiseEstimator& estimator, const Eigen::Ref<const MatrixXf>& draws) {
  const Stack stack = MakeStack(weighted, prepared);
  const int count = static_cast<int>(draws.rows());
  const MatrixXf squared = stack.directions.cwiseAbs2();
  MatrixXf statistics(draws.cols(), static_cast<int>(stack.candidates.size()));
  Reweighted lot{MatrixXf::Zero(count, kLot), MatrixXf::Zero(count, kLot),
                 std::vector<MatrixXf>(kLot), VectorXf(kLot), VectorXf(kLot)};
  for (int first = 0; first < draws.cols(); first += kLot) {
    const int size = std::min(kLot, static_cast<int>(draws.cols()) - first);
    for (int d = 0; d < size; ++d) {
      if (weighted.progress.Stopped()) return statistics.topRows(first);
      Reweight(weighted, stack, estimator, stack.used.cwiseProduct(draws.col(first + d)), d, &lot);
      weighted.progress.Count();
    }
    const MatrixXf lengths = TransposedTimes(squared, lot.weights).cwiseMax(1e-12F);
    const MatrixXf scores = TransposedTimes(stack.directions, lot.rest);
    for (int d = 0; d < size; ++d) {
      const VectorXf length = lengths.col(d),
                     along = scores.col(d).cwiseQuotient(length.cwiseSqrt());
      for (std::size_t c = 0; c < stack.candidates.size(); ++c) {
        const float best = LargestReweighted(stack, c, lot, d, along, length);
        statistics(first + d, static_cast<int>(c)) = static_cast<float>(
            Statistic(best, lot.sums[d], prepared.degrees, weighted.least_variance));
      }
    }
  }
  return statistics;
}

}  // namespace lyrefit
