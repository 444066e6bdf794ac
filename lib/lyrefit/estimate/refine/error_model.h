#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "lyrefit/base/dense.h"

namespace lyrefit {

// Errors of readings along sweeps: an independent error of each reading, and a rough path (an
// Ornstein-Uhlenbeck process) shared by neighbours,
//
//   cov(j, k) = white_k^2 [j = k] + path_j path_k exp(-|position_j - position_k|) [one chain],
//
// The path describes both light that wanders during the sweep and a module that departs from the
// model. All in the unit of the residuals.
struct ErrorModel {
  std::vector<double> white;  // standard deviation of the independent error; may be 0 with a path
  std::vector<double> path;   // standard deviation of the path; empty: there is no path
  std::vector<double> position;  // along the path, in units of its length; ascending in a chain
  std::vector<int> chain;        // same number: consecutive readings of one path
  // For rows that are means of neighbours: the part of path^2 by which averaging lowers their
  // variance but not their covariance with others. Empty: every row is one reading.
  std::vector<double> averaged_away;
  // The rows in the order along the chains, where that is not the order of the rows. Whiten and
  // DrawErrors follow it; CovarianceTimes takes rows in order only.
  std::vector<int> order;

  int size() const { return static_cast<int>(white.size()); }
};

// One reading of the filter that whitens a chain: its prediction and its innovation.
struct FilterStep {
  double path = 0;    // of the reading
  double kept = 0;    // correlation of its path with that of the reading before
  double learnt = 0;  // change of the predicted path per innovation
  double total = 1;   // variance of the innovation

  // The innovations of the columns of one row over their standard deviation. `state`: prediction of
  // the path in each column. `white` may be `row`.
  void Whiten(Eigen::Index columns, const double* row, double* state, double* white) const {
    const double scale = 1 / std::sqrt(total);
    for (Eigen::Index c = 0; c < columns; ++c) {
      const double foretold = kept * state[c];
      const double news = row[c] - path * foretold;
      state[c] = foretold + learnt * news;
      white[c] = news * scale;
    }
  }
};

// Variance of the predicted path, in units of that of the path.
class PathFilter {
 public:
  // The next reading, with the variance `own` of its independent error.
  FilterStep Next(double own, double path, double kept) {
    const double variance = kept * kept * variance_ + (1 - kept * kept);
    const double total = path * path * variance + own;
    variance_ = variance * (own / total);
    return {path, kept, path * variance / total, total};
  }

 private:
  double variance_ = 1;
};

// What whitens rows of one error model: its filter, which does not depend on the rows.
class Whitening {
 public:
  // Rows that are not `used` become 0; empty: all are used.
  Whitening(const ErrorModel& errors, const std::vector<char>& used);
  // See Whiten.
  void Apply(Eigen::Ref<RowMatrix> rows) const;
  double log_determinant() const { return log_determinant_; }

 private:
  bool has_path_;
  std::vector<int> order_;         // used rows, along the chains
  std::vector<int> left_out_;      // the others
  std::vector<FilterStep> steps_;  // of the used rows in that order
  double log_determinant_ = 0;
};

// Whitens the rows in place to independent errors of unit variance. The path is a first-order
// state: each row becomes its Kalman innovation, its difference from the prediction by earlier rows
// of its chain. Exact, and linear in the rows. Rows that are not `used` become 0; empty: all are
// used. Returns the sum of ln variance of the innovations, which is ln det cov of the used rows.
double Whiten(const ErrorModel& errors, const std::vector<char>& used, Eigen::Ref<RowMatrix> rows);

// The covariance times rows, one for each reading; linear in the rows.
RowMatrix CovarianceTimes(const ErrorModel& errors, const RowMatrix& rows);

// ln of the restricted likelihood of the errors, up to a constant, given residuals and their
// derivatives by the fitted parameters (Patterson and Thompson 1971, doi:10.1093/biomet/58.3.545).
double RestrictedLogLikelihood(const ErrorModel& errors, const std::vector<char>& used,
                               const Eigen::VectorXd& residual, const RowMatrix& jacobian);

}  // namespace lyrefit
