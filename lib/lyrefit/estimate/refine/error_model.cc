#include "lyrefit/estimate/refine/error_model.h"

namespace lyrefit {
namespace {

// Variance of a row by itself. Below 0 if averaging removes more path variance from a mean of
// neighbours than its independent variance. With the path the full matrix is a covariance all the
// same.
double OwnVariance(const ErrorModel& errors, int k) {
  const double own = errors.white[k] * errors.white[k];
  if (errors.averaged_away.empty() || errors.path.empty()) return own;
  return own - errors.path[k] * errors.path[k] * errors.averaged_away[k];
}

}  // namespace

Whitening::Whitening(const ErrorModel& errors, const std::vector<char>& used)
    : has_path_(!errors.path.empty()) {
  PathFilter filter;
  int before = -1;
  for (int place = 0; place < errors.size(); ++place) {
    const int k = errors.order.empty() ? place : errors.order[place];
    if (!used.empty() && used[k] == 0) {
      left_out_.push_back(k);
      continue;
    }
    FilterStep step;
    step.total = OwnVariance(errors, k);
    if (has_path_) {
      const bool follows = before >= 0 && errors.chain[before] == errors.chain[k];
      const double kept = follows ? std::exp(errors.position[before] - errors.position[k]) : 0.0;
      step = filter.Next(step.total, errors.path[k], kept);
    }
    log_determinant_ += std::log(step.total);
    order_.push_back(k);
    steps_.push_back(step);
    before = k;
  }
}

void Whitening::Apply(Eigen::Ref<RowMatrix> rows) const {
  const Eigen::Index columns = rows.cols();
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(columns);  // prediction of the path
  for (const int k : left_out_) rows.row(k).setZero();
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const FilterStep& step = steps_[place];
    double* const row = rows.data() + order_[place] * rows.outerStride();
    if (has_path_) {
      step.Whiten(columns, row, state.data(), row);
      continue;
    }
    const double scale = 1 / std::sqrt(step.total);
    for (Eigen::Index c = 0; c < columns; ++c) row[c] *= scale;
  }
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a view
double Whiten(const ErrorModel& errors, const std::vector<char>& used, Eigen::Ref<RowMatrix> rows) {
  const Whitening whitening(errors, used);
  whitening.Apply(rows);
  return whitening.log_determinant();
}

RowMatrix CovarianceTimes(const ErrorModel& errors, const RowMatrix& rows) {
  RowMatrix product = rows;
  for (int k = 0; k < errors.size(); ++k) product.row(k) *= OwnVariance(errors, k);
  if (errors.path.empty()) return product;
  // Covariances of each reading with earlier readings and itself, then with later ones.
  const auto kept = [&](int a, int b) {
    return errors.chain[a] == errors.chain[b] ? std::exp(errors.position[a] - errors.position[b])
                                              : 0.0;
  };
  Eigen::RowVectorXd shared = Eigen::RowVectorXd::Zero(rows.cols());
  for (int k = 0; k < errors.size(); ++k) {
    if (k > 0) shared *= kept(k - 1, k);
    shared += errors.path[k] * rows.row(k);
    product.row(k) += errors.path[k] * shared;
  }
  shared.setZero();
  for (int k = errors.size() - 2; k >= 0; --k) {
    shared = kept(k, k + 1) * (shared + errors.path[k + 1] * rows.row(k + 1));
    product.row(k) += errors.path[k] * shared;
  }
  return product;
}

double RestrictedLogLikelihood(const ErrorModel& errors, const std::vector<char>& used,
                               const Eigen::VectorXd& residual, const RowMatrix& jacobian) {
  const int columns = static_cast<int>(jacobian.cols());
  RowMatrix rows(residual.size(), columns + 1);
  for (int c = 0; c < columns; ++c) {
    const double norm = jacobian.col(c).norm();
    rows.col(c) = jacobian.col(c) / (norm > 0 ? norm : 1);
  }
  rows.col(columns) = residual;
  double logs = Whiten(errors, used, rows);
  Eigen::VectorXd rest = rows.col(columns);
  if (columns > 0) {
    const Eigen::MatrixXd slopes = rows.leftCols(columns);
    rest -= Times(slopes, LeastSquares(slopes, rest));
    const RightSingular decomposed = FindRightSingular(slopes);
    for (const double value : decomposed.values) {
      if (value > 1e-12 * decomposed.values[0]) logs += 2 * std::log(value);
    }
  }
  return -0.5 * (logs + rest.squaredNorm());
}

}  // namespace lyrefit
