#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace lyrefit {

// Regression of a daily series with errors that neighbouring days share:
//   y_i = X_i b + u_i + e_i
// u is a first-order autoregressive process in continuous time, with correlation
// exp(-ln 2 |t_i - t_j| / half_life) between days, so that gaps need no filling; e is independent,
// with a variance that falls with the number of measurements of the day, 1 + k / count. The Kalman
// filter of this state whitens the series and the columns of X in linear time (Harvey 1989,
// "Forecasting, Structural Time Series Models and the Kalman Filter", 3.4). Days far from the
// regression get a larger spread (Huber's weights, by the errors of the highest restricted likelihood),
// so that they do not steer it. The sizes and the half-life are means over a grid, weighted by the
// restricted likelihood.

constexpr double kYear_days = 365.25;

// Sizes of the errors of a series.
struct NoiseModel {
  double sigma = 0;           // of e on a day of spread 1, in the unit of the series
  double shared_sigma = 0;    // of u, in the same unit
  double half_life_days = 0;  // of u; 0: there is no u
};

// A daily series and its regression.
struct TimeSeries {
  std::vector<double> days;    // ascending
  std::vector<double> values;  // one for each day
  std::vector<double> counts;  // measurements of each day
  std::vector<double> spread;  // relative variance of e, 1 on a usual day; set by FitTime
};

// Divides out the errors of a series: W with W C W' = I, in units of `sigma`, for their covariance
// C. All in linear time.
class ErrorFilter {
 public:
  ErrorFilter(const NoiseModel& noise, const TimeSeries& series);
  // `ratio`: variance of u over that of e on a day of spread 1.
  ErrorFilter(double ratio, double half_life_days, const TimeSeries& series);

  // W applied to each column.
  Eigen::MatrixXd Whiten(const Eigen::MatrixXd& columns) const;
  // The transpose of W applied to a column.
  Eigen::VectorXd WhitenBack(const Eigen::VectorXd& white) const;
  // Squared norm of a whitened column that is 0 before position `first`, value(i) from there on.
  template <class Value>
  double SquaredNorm(Eigen::Index first, const Value& value) const {
    double state = 0, norm = 0;
    for (Eigen::Index i = first; i < variance_.size(); ++i) {
      if (i > first) state *= fade_[i];
      const double innovation = value(i) - state;
      norm += innovation * innovation / variance_[i];
      state += gain_[i] * innovation;
    }
    return norm;
  }
  double log_determinant() const { return variance_.array().log().sum(); }  // of C

 private:
  Eigen::VectorXd fade_;      // of the state from the day before
  Eigen::VectorXd gain_;      // share of an innovation that the state takes over
  Eigen::VectorXd variance_;  // of an innovation
};

// Variance of the sum of the errors with these weights, in the squared unit of the series.
double ErrorVariance(const NoiseModel& noise, const TimeSeries& series,
                     const std::vector<double>& weights);

struct TimeFit {
  NoiseModel noise;
  std::vector<double> spread;  // of the series; larger on days of few measurements and outliers
  std::vector<double> usual_spread;  // without outliers
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;  // of the coefficients
  double degrees = 0;          // of freedom of the sizes of the errors, as independent days
  double t_95() const;         // Student's factor of a 95 % interval
};

// Fits the regression with the columns `design` (days x coefficients, full rank; at least two days
// more than columns).
TimeFit FitTime(const TimeSeries& series, const Eigen::MatrixXd& design);

}  // namespace lyrefit
