#pragma once

#include <Eigen/Core>
#include <vector>

#include "lyrefit/base/dense.h"

namespace lyrefit {

// Errors of readings along sweeps: each its own, and a rough path that neighbours share,
//
//   cov(j, k) = white_k^2 [j = k] + path_j path_k exp(-|position_j - position_k|) [one chain],
//
// which stands for light that wanders during the sweep and for a module that departs from the model
// alike. All in the unit of the residuals.
struct ErrorModel {
  std::vector<double> white;  // standard deviation of a reading's own error; may be 0 with a path
  std::vector<double> path;   // of its part in the path; empty: there is no path
  std::vector<double> position;  // along the path, in its lengths; no falling within a chain
  std::vector<int> chain;        // readings of one path, which follow each other, have one number
  // Of rows that are means of neighbours: the part of path^2 that averaging has taken from their
  // variance, not from what they share with others. Empty: every row is one reading.
  std::vector<double> averaged_away;

  int size() const { return static_cast<int>(white.size()); }
};

// Row by row, in place: errors of unit size that know nothing of each other. The path is a
// first-order state: each row less what the rows before it in its chain foretell (Kalman's
// innovation), exactly and in proportion to the rows. Rows that are not `used` become 0; empty: all
// are. Returns the sum of ln variance of the innovations, which is ln det cov of the used rows.
double Whiten(const ErrorModel& errors, const std::vector<char>& used, Eigen::Ref<RowMatrix> rows);

// The covariance times rows, one for each reading; in proportion to them.
RowMatrix CovarianceTimes(const ErrorModel& errors, const RowMatrix& rows);

// ln of the restricted likelihood, up to a constant: of the errors, given residuals and their
// derivatives by what was fitted to them (Patterson and Thompson 1971,
// doi:10.1093/biomet/58.3.545).
double RestrictedLogLikelihood(const ErrorModel& errors, const std::vector<char>& used,
                               const Eigen::VectorXd& residual, const RowMatrix& jacobian);

}  // namespace lyrefit
