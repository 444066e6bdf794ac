#include "lyrefit/certify/correlation.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "certify/made.h"

namespace lyrefit {
namespace {

Eigen::VectorXd RandomVector(Eigen::Index size, RandomStream* random) {
  Eigen::VectorXd y(size);
  for (double& value : y) value = random->Normal();
  return y;
}

double LargestOnGrid(const Eigen::VectorXd& vd, double scale, const Eigen::VectorXd& y,
                     const std::vector<Window>& windows) {
  constexpr int kSteps = 4000;
  double largest = -1e300;
  for (const Window& window : windows) {
    for (int i = 0; i <= kSteps; ++i) {
      const double u = window.lower + (window.upper - window.lower) * i / kSteps;
      largest = std::max(largest, DiodeColumn(vd, scale, u).dot(y));
    }
  }
  return largest;
}

TEST(BoundCorrelation, IsNeverBelowTheLargestValueAndNotFarAboveIt) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  RandomStream random(1);
  for (int trial = 0; trial < 60; ++trial) {
    const Eigen::VectorXd vd = data.voltage_V + 0.06 * random.Uniform() * data.current_A;
    const Eigen::VectorXd y = RandomVector(vd.size(), &random);
    Window wide = WindowOf(curve, 0.5, 4);
    const double a = wide.lower + random.Uniform() * (wide.upper - wide.lower);
    const double b = a + 0.01 * random.Uniform() * (wide.upper - a);
    for (const std::vector<Window>& windows :
         {std::vector<Window>{wide}, {{a, b}}, {{wide.lower, a}, {b, wide.upper}}}) {
      const double largest = LargestOnGrid(vd, data.reference_voltage_V, y, windows);
      const auto found = BoundCorrelation(vd, data.reference_voltage_V, y, windows, {}, 1e-9);
      EXPECT_GE(found.bound, largest * (1 - 1e-12));
      // A positive correlation is bounded with the coarse relative accuracy of the first pieces.
      EXPECT_LE(found.bound, std::max(1e-9, 1.6 * std::max(largest, 0.0)));
      EXPECT_GE(found.best, std::max(0.0, 0.9 * largest));
    }
  }
}

// `y` with the smallest change that makes its products with the columns equal to `wanted`.
Eigen::VectorXd Moved(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns,
                      const Eigen::VectorXd& wanted) {
  return y +
         columns * (columns.transpose() * columns).ldlt().solve(wanted - columns.transpose() * y);
}

// A single evaluation on a window where the correlation is zero at both ends and positive between
// them. There the bound is tight.
TEST(BoundCorrelation, IsNotBelowABulgeBetweenTheEndsOfAPiece) {
  const IvCurve curve = Shipped("rtc_france");
  const Eigen::VectorXd vd = DataOf(curve).voltage_V;
  const double scale = vd.maxCoeff();
  const Window wide = WindowOf(curve, 0.5, 4);
  RandomStream random(3);
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double u = wide.lower + random.Uniform() * (wide.upper - wide.lower);
    const std::vector<Window> window = {{u, u + 0.3 * random.Uniform()}};
    Eigen::MatrixXd ends(vd.size(), 2);
    ends << DiodeColumn(vd, scale, u), DiodeColumn(vd, scale, window[0].upper);
    const Eigen::VectorXd y =
        Moved(RandomVector(vd.size(), &random), ends, Eigen::Vector2d::Zero());
    const double largest = LargestOnGrid(vd, scale, y, window);
    if (largest < 1e-9) continue;
    ++seen;
    EXPECT_GE(BoundCorrelation(vd, scale, y, window, {}, 1e9).bound, largest);
  }
  EXPECT_GT(seen, 50);
}

// The bound must cover a correlation that is negative at both ends and positive between them.
TEST(BoundBend, SeesWhatRisesAboveZeroBetweenTwoResistances) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const double scale = data.reference_voltage_V;
  RandomStream random(4);
  int seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double u = WindowOf(curve, 1, 2).lower * (1 + random.Uniform());
    const double rs = 0.06 * random.Uniform();
    const double dr = 0.05 * random.Uniform();
    const auto column = [&](double t) {
      return DiodeColumn(data.voltage_V + (rs + t * dr) * data.current_A, scale, u);
    };
    Eigen::MatrixXd ends(data.voltage_V.size(), 2);
    ends << column(0), column(1);
    const Eigen::VectorXd y =
        Moved(RandomVector(ends.rows(), &random), ends, Eigen::Vector2d(-1e-9, -1e-9));
    if (column(0.5).dot(y) <= 1e-6) continue;
    ++seen;
    const double bend = BoundBend(data, {{u, u * (1 + 1e-6)}}, rs, rs + dr, y, y, scale);
    for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      EXPECT_LE(column(t).dot(y), 0.5 * t * (1 - t) * bend * (1 + 1e-9));
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(BoundBend, BoundsWhatTheCorrelationRisesBetweenTwoResistances) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 0.5, 4);
  const double scale = data.reference_voltage_V;
  RandomStream random(2);
  for (int trial = 0; trial < 40; ++trial) {
    const double rs = 0.06 * random.Uniform();
    const double dr = 0.02 * random.Uniform();
    const Eigen::VectorXd y0 = RandomVector(data.voltage_V.size(), &random);
    const Eigen::VectorXd y1 = y0 + 0.1 * RandomVector(y0.size(), &random);
    const double bend = BoundBend(data, {window}, rs, rs + dr, y0, y1, scale);
    const auto correlation = [&](double u, double t) {
      const Eigen::VectorXd vd = data.voltage_V + (rs + t * dr) * data.current_A;
      const Eigen::VectorXd y = y0 + t * (y1 - y0);
      return u > 0 ? DiodeColumn(vd, scale, u).dot(y) : -vd.dot(y) / scale;
    };
    for (int i = -1; i <= 100; ++i) {  // -1: the shunt
      const double u = i < 0 ? 0 : window.lower + (window.upper - window.lower) * i / 100;
      const double ends = std::max({0.0, correlation(u, 0), correlation(u, 1)});
      for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        EXPECT_LE(correlation(u, t), ends + 0.5 * t * (1 - t) * bend + 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace lyrefit
