#include "lyrefit/certify/mixture.h"

#include <gtest/gtest.h>

#include "certify/made.h"

namespace lyrefit {
namespace {

constexpr double kMixtureTolerance = 1e-10;

double BoundDarkCurrent(const MixtureData& data) {
  return 2 * data.current_A.cwiseAbs().maxCoeff();
}

// Half the sum of squares of a good mixture on a grid of n, by projected coordinate descent. It is
// an upper bound of the minimum.
double OnGrid(const MixtureData& data, const Window& window, double rs, int diodes) {
  const Eigen::VectorXd vd = data.voltage_V + rs * data.current_A;
  Eigen::MatrixXd a(vd.size(), 2 + diodes);
  a.col(0).setOnes();
  a.col(1) = -vd;
  for (int j = 0; j < diodes; ++j) {
    const double u = window.lower + (window.upper - window.lower) * j / (diodes - 1);
    a.col(2 + j) = DiodeColumn(vd, data.reference_voltage_V, u);
  }
  Eigen::VectorXd x = Eigen::VectorXd::Zero(a.cols());
  Eigen::VectorXd r = data.current_A;
  const Eigen::VectorXd squares = a.colwise().squaredNorm();
  for (int sweep = 0; sweep < 20000; ++sweep) {
    for (int j = 0; j < a.cols(); ++j) {
      const double moved = std::max(0.0, x[j] + a.col(j).dot(r) / squares[j]);
      r -= (moved - x[j]) * a.col(j);
      x[j] = moved;
    }
  }
  return 0.5 * r.squaredNorm();
}

TEST(SolveMixture, ProvesItsOwnValue) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const Window window = WindowOf(curve, 1, 2);
    const double rs = 0.05 * data.reference_voltage_V / data.current_A.maxCoeff();
    const Mixture mixture =
        SolveMixture(data, {window}, rs, {}, kMixtureTolerance, BoundDarkCurrent(data));
    EXPECT_LT(mixture.relative_gap, 1e-8) << curve.name;
    EXPECT_NEAR(mixture.dual / mixture.primal, 1, 1e-8) << curve.name;
    const Eigen::VectorXd vd = data.voltage_V + rs * data.current_A;
    for (int i = 0; i <= 2000; ++i) {
      const double u = window.lower + (window.upper - window.lower) * i / 2000;
      EXPECT_LE(DiodeColumn(vd, mixture.scale_voltage_V, u).dot(mixture.y),
                mixture.excess + 1e-15 * data.current_A.norm())
          << curve.name;
    }
    for (const Atom& atom : mixture.atoms) {
      EXPECT_GE(atom.u, window.lower);
      EXPECT_LE(atom.u, window.upper);
      EXPECT_GT(atom.current_A, 0);
    }
  }
}

TEST(SolveMixture, IsNoWorseThanTheBestOnAGrid) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 1, 2);
  for (const double rs : {0.0, 0.02, 0.0367, 0.05}) {
    const Mixture mixture =
        SolveMixture(data, {window}, rs, {}, kMixtureTolerance, BoundDarkCurrent(data));
    const double grid = OnGrid(data, window, rs, 21);
    EXPECT_LE(mixture.primal, grid * (1 + 1e-9)) << rs;
    EXPECT_LE(mixture.dual, grid * (1 + 1e-12))
        << rs << ": the lower bound holds for every mixture";
    EXPECT_GE(mixture.primal, grid * 0.8) << rs << ": the grid comes near";
  }
}

TEST(SolveMixture, DoesNotDependOnWhereItStarts) {
  const IvCurve curve = Shipped("msx60");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 1, 2);
  const Mixture cold =
      SolveMixture(data, {window}, 0.29, {}, kMixtureTolerance, BoundDarkCurrent(data));
  const std::vector<Atom> elsewhere = {{window.lower, 1}, {window.upper, 1}};
  const Mixture warm =
      SolveMixture(data, {window}, 0.29, elsewhere, kMixtureTolerance, BoundDarkCurrent(data));
  EXPECT_NEAR(warm.primal / cold.primal, 1, 1e-8);
}

TEST(SolveMixture, KeepsToItsWindows) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window low = WindowOf(curve, 1.8, 2), high = WindowOf(curve, 1, 1.2);
  const Mixture mixture =
      SolveMixture(data, {low, high}, 0.036, {}, kMixtureTolerance, BoundDarkCurrent(data));
  ASSERT_FALSE(mixture.atoms.empty());
  for (const Atom& atom : mixture.atoms) {
    EXPECT_TRUE((atom.u >= low.lower && atom.u <= low.upper) ||
                (atom.u >= high.lower && atom.u <= high.upper));
  }
}

TEST(SolveMixture, KnowsItsSlopeOverRs) {
  const IvCurve curve = Shipped("pwp201");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 1, 2);
  const auto solve = [&](double rs) {
    return SolveMixture(data, {window}, rs, {}, kMixtureTolerance, BoundDarkCurrent(data));
  };
  constexpr double kStep = 1e-5;
  const double numerical = (solve(1.1 + kStep).primal - solve(1.1 - kStep).primal) / (2 * kStep);
  EXPECT_NEAR(solve(1.1).slope / numerical, 1, 1e-5);
}

}  // namespace
}  // namespace lyrefit
