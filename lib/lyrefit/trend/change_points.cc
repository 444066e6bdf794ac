// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/change_points.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/random.h"

namespace lyrefit {
namespace {

constexpr std::size_t kLeastDays = 10;        // on each side of a change
constexpr std::size_t kMostCandidates = 400;  // days that are tried

// Of the column of a change, days after it.
double ChangeValue(ChangeKind kind, double after_days) {
  return kind == ChangeKind::kStep ? 1 : (after_days + 0.5) / kYear_days;
}

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

// Gains of every candidate: the drop of the sum of squares over the variance that is left. A
// whitened candidate times a whitened series is the candidate, mostly ones, times that series
// whitened back: a sum over the days from the change on.
class ChangeScan {
 public:
  ChangeScan(const NoiseModel& noise, const TimeSeries& series, const Eigen::MatrixXd& design,
             const std::vector<ChangeCandidate>& candidates)
      : filter_(noise, series), days_(series.days), candidates_(candidates) {
    const auto n = design.rows();
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(filter_.Whiten(design));
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(n, design.cols());
    degrees_ = static_cast<double>(n - design.cols() - 1);
    const auto count = static_cast<Eigen::Index>(candidates.size());
    Eigen::VectorXd before(count), by_design = Eigen::VectorXd::Zero(count);
    for (Eigen::Index c = 0; c < count; ++c) {
      const ChangeCandidate& one = candidates[static_cast<std::size_t>(c)];
      before[c] = filter_.SquaredNorm(static_cast<Eigen::Index>(one.first), [&](Eigen::Index i) {
        return ChangeValue(one.kind, days_[static_cast<std::size_t>(i)] - days_[one.first]);
      });
    }
    for (Eigen::Index k = 0; k < basis_.cols(); ++k) {
      by_design += Products(basis_.col(k)).cwiseAbs2();
    }
    // Where the design has a candidate already, nothing is left of it.
    constexpr double kLeast = 1e-11;
    norms_ = (before - by_design).cwiseMax(0).cwiseSqrt();
    for (Eigen::Index c = 0; c < count; ++c) {
      if (!(norms_[c] * norms_[c] > kLeast * before[c])) norms_[c] = kInfinity;
    }
  }

  // Gains of the candidates for a whitened series.
  Eigen::VectorXd Gains(const Eigen::VectorXd& white) const {
    const Eigen::VectorXd left = white - basis_ * (basis_.transpose() * white);
    const double squares = left.squaredNorm();
    const Eigen::ArrayXd drops = Products(left).cwiseQuotient(norms_).array().square();
    return drops * degrees_ / (squares - drops).max(1e-12 * squares);
  }

  // Of a series as it is.
  Eigen::VectorXd GainsOf(const std::vector<double>& values) const {
    const Eigen::Map<const Eigen::VectorXd> column(values.data(), basis_.rows());
    return Gains(filter_.Whiten(column));
  }

  Eigen::Index days() const { return basis_.rows(); }
  // Of freedom of what a change leaves.
  double degrees() const { return degrees_; }
  // Chance that noise has a gain as large; at most this.
  double MostChance(double gain) const {
    return static_cast<double>(candidates_.size()) * FisherTail(gain, 1, degrees_);
  }

 private:
  // Every whitened candidate times a whitened series.
  Eigen::VectorXd Products(const Eigen::VectorXd& white) const {
    const Eigen::VectorXd back = filter_.WhitenBack(white);
    Eigen::VectorXd products(static_cast<Eigen::Index>(candidates_.size()));
    double sum = 0, ramp = 0;  // of `back` from a day on, times a step and an onset of that day
    std::size_t i = days_.size();
    for (Eigen::Index c = products.size() - 1; c >= 0; --c) {
      const ChangeCandidate& one = candidates_[static_cast<std::size_t>(c)];
      while (i > one.first) {
        if (i < days_.size()) ramp += sum * (days_[i] - days_[i - 1]) / kYear_days;
        --i;
        const double now = back[static_cast<Eigen::Index>(i)];
        sum += now;
        ramp += now * ChangeValue(ChangeKind::kOnset, 0);
      }
      products[c] = one.kind == ChangeKind::kStep ? sum : ramp;
    }
    return products;
  }

  ErrorFilter filter_;
  std::vector<double> days_;
  std::vector<ChangeCandidate> candidates_;
  Eigen::MatrixXd basis_;
  Eigen::VectorXd norms_;  // of what the design leaves of whitened candidates
  double degrees_ = 1;
};

// Share of series without a change whose largest gain is at least `gain`; at least `level` once it
// is above.
double ChanceOf(const ChangeScan& scan, double gain, const ChangeOptions& options,
                std::uint64_t run) {
  constexpr double kNever = 1e-12;
  const double all = 1.0 + options.draws;
  if (scan.MostChance(gain) < kNever) return 1 / all;  // none of the draws would be above
  RandomStream random(options.seed, run);
  Eigen::VectorXd white(scan.days());
  double above = 1;
  for (int draw = 0; draw < options.draws && above / all <= options.level; ++draw) {
    for (double& one : white) one = random.Normal();
    if (scan.Gains(white).maxCoeff() >= gain) ++above;
  }
  return above / all;
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
  out.gains = out.scan.GainsOf(series.values);
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
    column[i] = after >= -kRounding_days ? ChangeValue(kind, after) : 0;
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
    change.p_value = ChanceOf(found.scan, found.gains[best], options, out.changes.size());
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
