// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/time_model.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

struct Regression {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd inverse;    // of X'X, whitened
  Eigen::VectorXd residuals;  // whitened
  double variance = 0;        // of e on a usual day
};

Regression RegressionOf(const ErrorFilter& filter, const TimeSeries& series,
                        const Eigen::MatrixXd& design) {
  Eigen::MatrixXd all(design.rows(), design.cols() + 1);
  all << design, Eigen::Map<const Eigen::VectorXd>(series.values.data(), design.rows());
  const Eigen::MatrixXd white = filter.Whiten(all);
  const Eigen::MatrixXd x = white.leftCols(design.cols());
  const Eigen::VectorXd y = white.rightCols(1);
  const Eigen::MatrixXd cross = x.transpose() * x;
  const Eigen::LDLT<Eigen::MatrixXd> factor(cross);
  Regression out;
  out.coefficients = x.colPivHouseholderQr().solve(y);
  out.inverse = factor.solve(Eigen::MatrixXd::Identity(cross.rows(), cross.cols()));
  out.residuals = y - x * out.coefficients;
  const double degrees = static_cast<double>(design.rows() - design.cols());
  out.variance = std::max(out.residuals.squaredNorm() / degrees, 1e-300);
  return out;
}

// Restricted likelihoods of a regression under many errors. They do not depend on the basis of the
// design, nor on what of it the values contain, so an orthonormal one and residuals stand for them.
class Likelihoods {
 public:
  Likelihoods(const TimeSeries& series, const Eigen::MatrixXd& design)
      : degrees_(static_cast<double>(design.rows() - design.cols())) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(design);
    const Eigen::MatrixXd basis =
        qr.householderQ() * Eigen::MatrixXd::Identity(design.rows(), qr.rank());
    const Eigen::Map<const Eigen::VectorXd> values(series.values.data(), design.rows());
    columns_.resize(design.rows(), qr.rank() + 1);
    columns_ << basis, values - basis * (basis.transpose() * values);
  }

  // The logarithm, without constants, of the values over the root of `unit`; the variance of e on a
  // usual day.
  struct Found {
    double degrees = 0;
    double log_determinants = 0;
    double variance = 0;

    double Log(double unit = 1) const {
      return -0.5 * (degrees * std::log(variance / unit) + log_determinants);
    }
  };
  Found Of(const ErrorFilter& filter) const {
    const Eigen::MatrixXd white = filter.Whiten(columns_);
    const Eigen::MatrixXd cross = white.transpose() * white;
    const Eigen::Index p = cross.cols() - 1;
    const Eigen::LLT<Eigen::MatrixXd> factor(cross.topLeftCorner(p, p));
    const Eigen::VectorXd fitted = factor.matrixL().solve(cross.topRightCorner(p, 1));
    const double squares = cross(p, p) - fitted.squaredNorm();
    const double log_det = 2 * factor.matrixLLT().diagonal().array().max(1e-300).log().sum();
    const double variance = std::max(squares / degrees_, 1e-300);
    return {degrees_, filter.log_determinant() + log_det, variance};
  }

 private:
  double degrees_;
  Eigen::MatrixXd columns_;
};

// Variance of u over that of e, and half-lives in days, that are tried.
constexpr double kRatios[] = {0.1, 0.25, 0.5, 1, 2, 4, 8, 16, 40, 100};
constexpr double kHalfLives[] = {1, 2, 4, 8, 15, 30, 60, 120};

constexpr double kPerMeasurement[] = {0, 1, 3, 10, 30};  // k of 1 + k / count
// Of likelihoods. Where all days have as many measurements, any k has the same but for rounding.
constexpr double kTie = 1e-6;

struct BestNoise {
  double ratio = 0;
  double half_life = 0;
};

// Relative variances 1 + k / count, times those of `outlying`.
void SetSpread(double k, const std::vector<double>& outlying, TimeSeries* series) {
  series->spread.resize(series->days.size());
  for (std::size_t i = 0; i < series->spread.size(); ++i) {
    series->spread[i] = outlying[i] * (1 + k / series->counts[i]);
  }
}

// The errors of the highest restricted likelihood.
BestNoise BestNoiseOf(const std::vector<double>& outlying, const Likelihoods& likelihoods,
                      TimeSeries* fitted) {
  TimeSeries& series = *fitted;
  const auto likelihood = [&](double ratio, double half_life) {
    return likelihoods.Of(ErrorFilter(ratio, half_life, series)).Log();
  };
  double highest = -HUGE_VAL, usual = 0;
  for (const double k : kPerMeasurement) {
    SetSpread(k, outlying, &series);
    for (const double ratio : {0.0, 1.0, 8.0}) {
      const double one = likelihood(ratio, ratio > 0 ? 8 : 0);
      if (one <= highest + kTie) continue;
      highest = one;
      usual = k;
    }
  }
  SetSpread(usual, outlying, &series);
  BestNoise best;
  highest = likelihood(0, 0);
  const double span = series.days.back() - series.days.front();
  constexpr int kCount = static_cast<int>(std::size(kRatios));
  int at = kCount / 2;
  for (const double half_life : kHalfLives) {
    if (half_life > span / 3) break;
    // Uphill from the best ratio of the half-life before.
    double here = likelihood(kRatios[at], half_life);
    for (const int step : {1, -1}) {
      const int from = at;
      for (int next = at + step; next >= 0 && next < kCount; next += step) {
        const double there = likelihood(kRatios[next], half_life);
        if (there <= here) break;
        here = there;
        at = next;
      }
      if (at != from) break;
    }
    if (here > highest) {
      highest = here;
      best = {kRatios[at], half_life};
    }
  }
  return best;
}

// The mean of all errors that were tried, weighted by their restricted likelihoods: two that are
// almost as likely do not change places for a last digit of the data. Errors that no days share have
// the weight of all others before the data speak.
BestNoise MeanNoiseOf(const Likelihoods& likelihoods, const TimeSeries& series) {
  struct Tried {
    double ratio;
    double half_life;
    Likelihoods::Found found;
  };
  std::vector<Tried> tried;
  const auto add = [&](double ratio, double half_life) {
    tried.push_back({ratio, half_life, likelihoods.Of(ErrorFilter(ratio, half_life, series))});
  };
  add(0, 0);
  const double span = series.days.back() - series.days.front();
  for (const double half_life : kHalfLives) {
    if (half_life > span / 3) break;
    for (const double ratio : kRatios) add(ratio, half_life);
  }
  // Over the first variance, so that the unit of the series changes no bit.
  const double unit = tried.front().found.variance;
  const double others = std::max<double>(1, static_cast<double>(tried.size()) - 1);
  double highest = -HUGE_VAL;
  for (const Tried& one : tried) highest = std::max(highest, one.found.Log(unit));
  double own = 0, shared = 0, half_life = 0;
  for (const Tried& one : tried) {
    const double weight = std::exp(one.found.Log(unit) - highest) * one.found.variance / unit *
                          (one.ratio > 0 ? 1 : others);
    own += weight;
    if (!(one.ratio > 0)) continue;
    shared += weight * one.ratio;
    half_life += weight * one.ratio * std::log(one.half_life);
  }
  constexpr double kNone = 1e-3;  // of e: less is not shared
  if (!(shared > kNone * own)) return {};
  return {shared / own, std::exp(half_life / shared)};
}

// Independent days that would determine the sizes of the errors as well as these.
double EffectiveDays(const BestNoise& noise, const TimeSeries& series) {
  const double n = static_cast<double>(series.days.size());
  if (noise.half_life <= 0) return n;
  const double share = noise.ratio / (noise.ratio + 1);
  const double spacing = (series.days.back() - series.days.front()) / (n - 1);
  const double fade = std::exp2(-2 * spacing / noise.half_life);
  const double squares = 1 + 2 * share * share * fade / (1 - fade);
  return n / squares;
}

}  // namespace

ErrorFilter::ErrorFilter(double ratio, double half_life_days, const TimeSeries& series) {
  const auto n = static_cast<Eigen::Index>(series.days.size());
  fade_.resize(n);
  gain_.resize(n);
  variance_.resize(n);
  double state = ratio, last_gap = -1, fade = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double gap = i == 0 ? 0 : series.days[k] - series.days[k - 1];
    if (gap != last_gap) fade = half_life_days > 0 ? std::exp2(-gap / half_life_days) : 0;
    last_gap = gap;
    if (i > 0) state = fade * fade * state + (1 - fade * fade) * ratio;
    fade_[i] = i == 0 ? 0 : fade;
    variance_[i] = state + series.spread[k];
    gain_[i] = state / variance_[i];
    state *= 1 - gain_[i];
  }
}

ErrorFilter::ErrorFilter(const NoiseModel& noise, const TimeSeries& series)
    : ErrorFilter(std::pow(noise.shared_sigma / noise.sigma, 2), noise.half_life_days, series) {}

Eigen::MatrixXd ErrorFilter::Whiten(const Eigen::MatrixXd& columns) const {
  Eigen::MatrixXd white(columns.rows(), columns.cols());
  const Eigen::VectorXd scale = variance_.cwiseSqrt().cwiseInverse();
  Eigen::VectorXd state = Eigen::VectorXd::Zero(columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    for (Eigen::Index c = 0; c < columns.cols(); ++c) {
      const double faded = state[c] * fade_[i];
      const double innovation = columns(i, c) - faded;
      white(i, c) = innovation * scale[i];
      state[c] = faded + gain_[i] * innovation;
    }
  }
  return white;
}

Eigen::VectorXd ErrorFilter::WhitenBack(const Eigen::VectorXd& white) const {
  Eigen::VectorXd column(white.size());
  double state = 0;  // slope by the state after the day
  for (Eigen::Index i = white.size() - 1; i >= 0; --i) {
    column[i] = white[i] / std::sqrt(variance_[i]) + gain_[i] * state;
    state = fade_[i] * (state - column[i]);
  }
  return column;
}

double ErrorVariance(const NoiseModel& noise, const TimeSeries& series,
                     const std::vector<double>& weights) {
  double own = 0, shared = 0, before = 0;  // before: of earlier days, as far as today shares them
  for (std::size_t i = 0; i < weights.size(); ++i) {
    own += weights[i] * weights[i] * series.spread[i];
    if (noise.half_life_days <= 0) continue;
    if (i > 0) before *= std::exp2((series.days[i - 1] - series.days[i]) / noise.half_life_days);
    shared += weights[i] * (weights[i] + 2 * before);
    before += weights[i];
  }
  return noise.sigma * noise.sigma * own + noise.shared_sigma * noise.shared_sigma * shared;
}

double TimeFit::t_95() const { return StudentQuantile(0.975, std::max(degrees, 3.0)); }

TimeFit FitTime(const TimeSeries& series, const Eigen::MatrixXd& design) {
  constexpr int kRounds = 4;
  constexpr double kHuber = 2.5;  // residuals beyond it count less
  TimeSeries weighted = series;
  std::vector<double> outlying(series.days.size(), 1);
  BestNoise noise;
  Regression fit;
  const Likelihoods likelihoods(series, design);
  for (int round = 0; round < kRounds; ++round) {
    noise = BestNoiseOf(outlying, likelihoods, &weighted);
    fit = RegressionOf(ErrorFilter(noise.ratio, noise.half_life, weighted), weighted, design);
    if (round + 1 == kRounds) break;
    std::vector<double> sizes(outlying.size());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      sizes[i] = std::fabs(fit.residuals[static_cast<Eigen::Index>(i)]);
    }
    const double sigma = kMedianToSigma * Median(sizes);
    bool changed = false;
    for (std::size_t i = 0; i < outlying.size(); ++i) {
      const double size = sizes[i] / sigma;
      if (!(size > kHuber)) continue;
      outlying[i] *= (size / kHuber) * (size / kHuber);
      changed = true;
    }
    if (!changed) break;
  }
  noise = MeanNoiseOf(likelihoods, weighted);
  fit = RegressionOf(ErrorFilter(noise.ratio, noise.half_life, weighted), weighted, design);
  TimeFit out;
  out.noise = {std::sqrt(fit.variance), std::sqrt(fit.variance * noise.ratio), noise.half_life};
  out.spread = weighted.spread;
  out.usual_spread.resize(outlying.size());
  for (std::size_t i = 0; i < outlying.size(); ++i) {
    out.usual_spread[i] = weighted.spread[i] / outlying[i];
  }
  out.coefficients = fit.coefficients;
  out.covariance = fit.variance * fit.inverse;
  out.degrees = EffectiveDays(noise, weighted) - static_cast<double>(design.cols());
  return out;
}

}  // namespace lyrefit
