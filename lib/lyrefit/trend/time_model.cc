// Optimized fully: it runs once for each sweep of years.
#include "lyrefit/trend/time_model.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lyrefit/base/distributions.h"
#include "lyrefit/base/median.h"

namespace lyrefit {
namespace {

// Variances of the filter's predictions, of a usual day 1, and the weights of its corrections.
struct Gains {
  std::vector<double> fade;      // of the state from the day before
  std::vector<double> gain;      // share of an innovation that the state takes over
  std::vector<double> variance;  // of an innovation
};

// `ratio`: variance of u over that of e on a usual day.
Gains GainsOf(double ratio, double half_life, const TimeSeries& series) {
  const std::size_t n = series.days.size();
  Gains gains;
  gains.fade.resize(n);
  gains.gain.resize(n);
  gains.variance.resize(n);
  double state = ratio;
  for (std::size_t i = 0; i < n; ++i) {
    const double gap = i == 0 ? 0 : series.days[i] - series.days[i - 1];
    const double fade = half_life > 0 ? std::exp2(-gap / half_life) : 0;
    if (i > 0) state = fade * fade * state + (1 - fade * fade) * ratio;
    gains.fade[i] = i == 0 ? 0 : fade;
    gains.variance[i] = state + series.spread[i];
    gains.gain[i] = state / gains.variance[i];
    state *= 1 - gains.gain[i];
  }
  return gains;
}

Eigen::MatrixXd Filtered(const Gains& gains, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd white(columns.rows(), columns.cols());
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Zero(columns.cols());
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    state *= gains.fade[k];
    const Eigen::RowVectorXd innovation = columns.row(i) - state;
    white.row(i) = innovation / std::sqrt(gains.variance[k]);
    state += gains.gain[k] * innovation;
  }
  return white;
}

struct Regression {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd inverse;    // of X'X, whitened
  Eigen::VectorXd residuals;  // whitened
  double log_likelihood = 0;  // restricted, without constants
  double variance = 0;        // of e on a usual day
};

Regression RegressionOf(const Gains& gains, const TimeSeries& series,
                        const Eigen::MatrixXd& design) {
  Eigen::MatrixXd all(design.rows(), design.cols() + 1);
  all << design, Eigen::Map<const Eigen::VectorXd>(series.values.data(), design.rows());
  const Eigen::MatrixXd white = Filtered(gains, all);
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
  double log_variance = 0;
  for (const double v : gains.variance) log_variance += std::log(v);
  const double log_det = factor.vectorD().array().max(1e-300).log().sum();
  out.log_likelihood = -0.5 * (degrees * std::log(out.variance) + log_variance + log_det);
  return out;
}

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
BestNoise BestNoiseOf(const std::vector<double>& outlying, const Eigen::MatrixXd& design,
                      TimeSeries* fitted) {
  BestNoise best;
  TimeSeries& series = *fitted;
  double highest = -HUGE_VAL, usual = 0;
  for (const double k : kPerMeasurement) {
    SetSpread(k, outlying, &series);
    for (const double ratio : {0.0, 1.0, 8.0}) {
      const Regression one =
          RegressionOf(GainsOf(ratio, ratio > 0 ? 8 : 0, series), series, design);
      if (one.log_likelihood <= highest + kTie) continue;
      highest = one.log_likelihood;
      usual = k;
    }
  }
  SetSpread(usual, outlying, &series);
  highest = RegressionOf(GainsOf(0, 0, series), series, design).log_likelihood;
  const double span = series.days.back() - series.days.front();
  for (const double half_life : kHalfLives) {
    if (half_life > span / 3) break;
    for (const double ratio : kRatios) {
      const Regression one = RegressionOf(GainsOf(ratio, half_life, series), series, design);
      if (one.log_likelihood > highest) {
        highest = one.log_likelihood;
        best = {ratio, half_life};
      }
    }
  }
  return best;
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

Eigen::MatrixXd Whiten(const NoiseModel& noise, const TimeSeries& series,
                       const Eigen::MatrixXd& columns) {
  const double part = noise.shared_sigma / noise.sigma;
  return Filtered(GainsOf(part * part, noise.half_life_days, series), columns);
}

double ErrorCovariance(const NoiseModel& noise, const TimeSeries& series, std::size_t i,
                       std::size_t j) {
  double covariance = i == j ? noise.sigma * noise.sigma * series.spread[i] : 0;
  if (noise.half_life_days > 0) {
    covariance += noise.shared_sigma * noise.shared_sigma *
                  std::exp2(-std::fabs(series.days[i] - series.days[j]) / noise.half_life_days);
  }
  return covariance;
}

double TimeFit::t_95() const { return StudentQuantile(0.975, std::max(degrees, 3.0)); }

TimeFit FitTime(const TimeSeries& series, const Eigen::MatrixXd& design) {
  constexpr int kRounds = 4;
  constexpr double kHuber = 2.5;  // residuals beyond it count less
  TimeSeries weighted = series;
  std::vector<double> outlying(series.days.size(), 1);
  BestNoise noise;
  Regression fit;
  for (int round = 0; round < kRounds; ++round) {
    noise = BestNoiseOf(outlying, design, &weighted);
    fit = RegressionOf(GainsOf(noise.ratio, noise.half_life, weighted), weighted, design);
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
