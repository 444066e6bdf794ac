// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/change_points.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLeastDays = 10;        // on each side of a change
constexpr std::size_t kMostCandidates = 400;  // days that are tried

struct ChangeCandidate {
  ChangeKind kind;
  std::size_t first;  // index of the first day after it
};

std::vector<ChangeCandidate> CandidatesOf(const TimeSeries& series,
                                          const std::vector<ChangePoint>& changes) {
  std::vector<ChangeCandidate> candidates;
  const std::size_t n = series.days.size();
  if (n < 2 * kLeastDays) return candidates;
  const std::size_t every = 1 + (n - 2 * kLeastDays) / kMostCandidates;
  for (std::size_t i = kLeastDays; i + kLeastDays <= n; i += every) {
    const bool near = std::any_of(changes.begin(), changes.end(), [&](const ChangePoint& change) {
      return std::fabs(change.day - series.days[i]) < static_cast<double>(kLeastDays);
    });
    if (near) continue;
    candidates.push_back({ChangeKind::kStep, i});
    candidates.push_back({ChangeKind::kOnset, i});
  }
  return candidates;
}

Eigen::VectorXd ColumnOf(const TimeSeries& series, const ChangeCandidate& candidate) {
  return ChangeColumn(series, candidate.kind, series.days[candidate.first]);
}

Eigen::MatrixXd WithColumn(const Eigen::MatrixXd& design, const Eigen::VectorXd& column) {
  Eigen::MatrixXd wider(design.rows(), design.cols() + 1);
  wider << design, column;
  return wider;
}

// Gains of every candidate: the drop of the sum of squares over the variance that is left.
class ChangeScan {
 public:
  ChangeScan(const NoiseModel& noise, const TimeSeries& series, const Eigen::MatrixXd& design,
             const std::vector<ChangeCandidate>& candidates) {
    const auto n = design.rows();
    Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(candidates.size()));
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      columns.col(static_cast<Eigen::Index>(c)) = ColumnOf(series, candidates[c]);
    }
    const Eigen::MatrixXd white = Whiten(noise, series, design);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(white);
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(n, design.cols());
    columns_ = Whiten(noise, series, columns);
    const Eigen::VectorXd before = columns_.colwise().norm();
    columns_ -= basis_ * (basis_.transpose() * columns_);
    for (Eigen::Index c = 0; c < columns_.cols(); ++c) {
      const double left = columns_.col(c).norm();
      if (left > 1e-6 * before[c]) {
        columns_.col(c) /= left;
      } else {
        columns_.col(c).setZero();  // the design has it already
      }
    }
    degrees_ = static_cast<double>(n - design.cols() - 1);
  }

  // For each column of `white`, whitened series: gains of the candidates.
  Eigen::MatrixXd Gains(const Eigen::MatrixXd& white) const {
    const Eigen::MatrixXd left = white - basis_ * (basis_.transpose() * white);
    Eigen::MatrixXd gains = (columns_.transpose() * left).array().square();
    const Eigen::RowVectorXd squares = left.colwise().squaredNorm();
    for (Eigen::Index k = 0; k < gains.cols(); ++k) {
      gains.col(k) = (gains.col(k).array() * degrees_ /
                      (squares[k] - gains.col(k).array()).max(1e-12 * squares[k]))
                         .matrix();
    }
    return gains;
  }

  // Of freedom of what a change leaves.
  double degrees() const { return degrees_; }

 private:
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd columns_;
  double degrees_ = 1;
};

// Share of series without a change whose largest gain is at least `gain`.
double ChanceOf(const ChangeScan& scan, Eigen::Index days, double gain,
                const ChangeOptions& options, std::uint64_t run) {
  RandomStream random(options.seed, run);
  int above = 0;
  constexpr int kTogether = 64;
  for (int done = 0; done < options.draws; done += kTogether) {
    const int now = std::min(kTogether, options.draws - done);
    Eigen::MatrixXd white(days, now);
    for (Eigen::Index k = 0; k < white.size(); ++k) white.data()[k] = random.Normal();
    const Eigen::MatrixXd gains = scan.Gains(white);
    for (int k = 0; k < now; ++k) above += gains.col(k).maxCoeff() >= gain ? 1 : 0;
  }
  return (1.0 + above) / (1.0 + options.draws);
}

// The candidates under the errors of a fit, and their gains.
struct ScannedChanges {
  ChangeScan scan;
  Eigen::VectorXd gains;
};

ScannedChanges ScanUnder(const TimeFit& fit, const TimeSeries& series,
                         const Eigen::MatrixXd& design,
                         const std::vector<ChangeCandidate>& candidates) {
  TimeSeries own = series;
  own.spread = fit.spread;
  ScannedChanges out = {ChangeScan(fit.noise, own, design, candidates), {}};
  const Eigen::MatrixXd values =
      Eigen::Map<const Eigen::VectorXd>(series.values.data(), design.rows());
  out.gains = out.scan.Gains(Whiten(fit.noise, own, values));
  return out;
}

// The days whose gain is so near the largest that the likelihood does not exclude them. The sum of
// squares that a change leaves is proportional to 1 / (degrees + gain).
void FindRange(const TimeSeries& series, const std::vector<ChangeCandidate>& candidates,
               const Eigen::VectorXd& gains, double degrees, std::size_t best,
               ChangePoint* change) {
  constexpr double kWidth = 3.84;  // of chi-squared, one degree, 95 %
  change->day_low = change->day_high = change->day;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (candidates[c].kind != candidates[best].kind) continue;
    const double less = degrees * std::log((degrees + gains[static_cast<Eigen::Index>(best)]) /
                                           (degrees + gains[static_cast<Eigen::Index>(c)]));
    if (less > kWidth) continue;
    // It may have happened on any day since the last one with data.
    const std::size_t first = candidates[c].first;
    const double since = std::min(series.days[first - 1] + 1, series.days[first]);
    change->day_low = std::min(change->day_low, since);
    change->day_high = std::max(change->day_high, series.days[first]);
  }
}

}  // namespace

Eigen::VectorXd ChangeColumn(const TimeSeries& series, ChangeKind kind, double day) {
  constexpr double kRounding_days = 1e-6;  // `day` may come from a time in seconds
  Eigen::VectorXd column(static_cast<Eigen::Index>(series.days.size()));
  for (Eigen::Index i = 0; i < column.size(); ++i) {
    const double after = series.days[static_cast<std::size_t>(i)] - day;
    const double value = kind == ChangeKind::kStep ? 1 : (after + 0.5) / kYear_days;
    column[i] = after >= -kRounding_days ? value : 0;
  }
  return column;
}

ChangingSeries FitChanges(const TimeSeries& series, const Eigen::MatrixXd& design,
                          const ChangeOptions& options) {
  ChangingSeries out;
  out.design = design;
  out.fit = FitTime(series, design);
  while (static_cast<int>(out.changes.size()) < options.most) {
    const std::vector<ChangeCandidate> candidates = CandidatesOf(series, out.changes);
    if (candidates.empty()) break;
    ScannedChanges found = ScanUnder(out.fit, series, out.design, candidates);
    // The errors with the best change in the regression, and the best change under these errors.
    TimeFit with;
    Eigen::Index best = 0;
    for (int round = 0; round < 2; ++round) {
      found.gains.maxCoeff(&best);
      const Eigen::VectorXd column = ColumnOf(series, candidates[static_cast<std::size_t>(best)]);
      with = FitTime(series, WithColumn(out.design, column));
      found = ScanUnder(with, series, out.design, candidates);
    }
    found.gains.maxCoeff(&best);
    ChangePoint change;
    change.p_value =
        ChanceOf(found.scan, design.rows(), found.gains[best], options, out.changes.size());
    if (change.p_value > options.level) break;
    const auto at = static_cast<std::size_t>(best);
    change.kind = candidates[at].kind;
    change.day = series.days[candidates[at].first];
    change.column = static_cast<int>(out.design.cols());
    FindRange(series, candidates, found.gains, found.scan.degrees(), at, &change);
    out.design = WithColumn(out.design, ColumnOf(series, candidates[at]));
    out.fit = FitTime(series, out.design);
    out.changes.push_back(change);
  }
  return out;
}

}  // namespace lyrefit
