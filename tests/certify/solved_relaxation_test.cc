#include "lyrefit/certify/solved_relaxation.h"

#include <gtest/gtest.h>

#include "certify/made.h"
#include "lyrefit/certify/branch.h"
#include "lyrefit/certify/mixture.h"
#include "lyrefit/certify/solved_part.h"
#include "repeats.h"

namespace lyrefit {
namespace {

double SolvedHalf(const MixtureData& data, const Mixture& mixture) {
  return 0.5 *
         data.weight.cwiseProduct(SolvedCurrents(data, mixture) - data.target_A).squaredNorm();
}

BranchLimits SolvedLimits(const MixtureData& data, double gap) {
  BranchLimits limits;
  limits.rs_upper = data.reference_voltage_V / data.current_A.maxCoeff();
  limits.tolerance = 2 * gap;
  return limits;
}

struct KnownOptimum {
  const char* curve;
  int diodes;  // 0: any number
  double rmse_A;
};

// Expected values have the digits on which two other computations agree (data/README.md).
TEST(SolvedRelaxation, ProvesTheKnownOptimaOfTheShippedCurves) {
  SKIP_IF_SANITIZED();
  const KnownOptimum optima[] = {
      {"rtc_france", 0, 7.326480809e-4},  {"rtc_france", 1, 7.730062690e-4},
      {"rtc_france", 2, 7.326480809e-4},  {"pwp201", 0, 2.052960641e-3},
      {"pwp201", 1, 2.052960641e-3},      {"pwp201", 2, 2.052960641e-3},
      {"stm6_40_36", 1, 1.721921512e-3},  {"stm6_40_36", 2, 1.673843372e-3},
      {"stp6_120_36", 1, 1.425106356e-2}, {"stp6_120_36", 2, 1.425106356e-2},
      {"msx60", 0, 2.166585456e-5},       {"msx60", 1, 1.494824459e-4},
      {"msx60", 2, 2.209161239e-5},       {"msx60", 3, 2.166585456e-5}};
  for (const KnownOptimum& optimum : optima) {
    const IvCurve curve = Shipped(optimum.curve);
    const MixtureData data = DataOf(curve);
    const double half = 0.5 * static_cast<double>(curve.size()) * optimum.rmse_A * optimum.rmse_A;
    const BranchEnd end = BranchOver(SolvedRelaxation(data), WindowOf(curve, 1, 2), optimum.diodes,
                                     half * (1 + 1e-8), SolvedLimits(data, 1e-8));
    EXPECT_TRUE(end.complete) << optimum.curve << " " << optimum.diodes;
    EXPECT_LE(end.lower, half * (1 + 2e-9)) << optimum.curve << " " << optimum.diodes;
    EXPECT_GE(end.lower, half * (1 - 4e-8)) << optimum.curve << " " << optimum.diodes;
  }
}

// A random mixture with diodes inside the windows of the part, optimal for its places or slightly
// perturbed.
Mixture DrawnMixture(const MixtureData& data, const BranchPart& part, RandomStream* random) {
  std::vector<Window> places;
  for (const Window& window : part.windows) {
    const double u = window.lower + (window.upper - window.lower) * random->Uniform();
    places.push_back({u, u});
  }
  const double rs = part.rs0 + (part.rs1 - part.rs0) * random->Uniform();
  Mixture drawn = SolveSolvedMixture(data, Union(places), rs, {}, 1e-8).mixture;
  const double off = std::pow(10, -5 + 4 * random->Uniform());
  for (double& x : drawn.linear) x *= 1 + off * random->Normal() * 0.1;
  for (Atom& atom : drawn.atoms) atom.current_A *= 1 + off * random->Normal();
  return drawn;
}

// The bound of a part holds for its mixtures: none that is at least as good as the best known lies
// below the bound.
TEST(SolvedRelaxation, NoMixtureOfAPartUndercutsIt) {
  int competing = 0;
  for (int seed = 900; seed < 900 + Repeats(16); ++seed) {
    const IvCurve curve = seed % 4 == 0 ? Shipped("rtc_france") : RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const Window whole = WindowOf(curve, seed % 2 == 0 ? 1 : 0.5, seed % 2 == 0 ? 2 : 4);
    const BranchLimits limits = SolvedLimits(data, 1e-3);
    BranchLimits few = limits;
    few.most_solved = 300;
    const SolvedRelaxation relaxation(data);
    const BranchEnd best = BranchOver(relaxation, whole, 0, kInfinity, few);
    ASSERT_GT(best.best.primal, 0);
    RandomStream random(static_cast<std::uint64_t>(seed));
    for (int trial = 0; trial < 6; ++trial) {
      Incumbent incumbent;
      incumbent.diodes = 1;
      incumbent.tolerance = 1e-6;
      incumbent.primal = best.best.primal * (1 + std::pow(10, -3 + 4 * random.Uniform()));
      incumbent.best.primal = 0;  // prevents an update of the best mixture
      const double known = incumbent.primal;
      const double width = std::pow(10, -4 * random.Uniform());
      BranchPart part;
      part.rs0 = std::max(0.0, best.best.rs * (1 - width * random.Uniform()));
      part.rs1 = best.best.rs * (1 + width * random.Uniform());
      for (const Atom& atom : best.best.atoms) {
        part.windows.push_back({std::max(whole.lower, atom.u * (1 - width * random.Uniform())),
                                std::min(whole.upper, atom.u * (1 + width * random.Uniform()))});
      }
      if (part.windows.empty()) part.windows = {whole};
      relaxation.Bound(nullptr, &part, &incumbent);
      for (int draw = 0; draw < 20; ++draw) {
        const Mixture drawn = DrawnMixture(data, part, &random);
        if (drawn.linear.size() == 0 || drawn.linear.minCoeff() < 0) continue;
        const double half = SolvedHalf(data, drawn);
        if (!(half <= known)) continue;
        ++competing;
        EXPECT_GE(half, part.lower * (1 - 1e-9)) << curve.name << " " << trial;
      }
    }
  }
  EXPECT_GT(competing, kSanitized ? 20 : 100);
}

TEST(SolvedRelaxation, NamesMixturesThatReachWhatItSays) {
  for (std::uint64_t seed = 940; seed < 950; ++seed) {
    const IvCurve curve = RandomCurve(seed);
    const MixtureData data = DataOf(curve);
    const SolvedMixture fit = SolveSolvedMixture(data, {WindowOf(curve, 1, 2)}, 0.01, {}, 1e-9);
    EXPECT_NEAR(SolvedHalf(data, fit.mixture) / fit.value, 1, 1e-9);
    const Mixture measured = SolveMixture(data, {WindowOf(curve, 1, 2)}, 0.01, {}, 1e-9, 10);
    EXPECT_LE(fit.value, SolvedHalf(data, measured) * (1 + 1e-9));
  }
}

TEST(SlopeBounds, HoldForEveryLawThroughTheValues) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 1, 2);
  RandomStream random(4);
  for (int trial = 0; trial < Repeats(100); ++trial) {
    Mixture mixture;
    mixture.linear = Eigen::Vector2d(0.76 + 0.01 * random.Uniform(), 0.02 * random.Uniform());
    for (int j = 0; j < 1 + static_cast<int>(random.Index(3)); ++j) {
      mixture.atoms.push_back({window.lower + (window.upper - window.lower) * random.Uniform(),
                               0.8 * random.Uniform()});
    }
    const MixtureLaw law(data, mixture);
    KnownValues known;
    known.voltage_V = data.voltage_V;
    known.value_A.resize(26);
    known.each_A.resize(26);
    known.shared = known.common_A = Eigen::VectorXd::Zero(26);
    const double unsure = std::pow(10, -5 + 3 * random.Uniform());
    for (int k = 0; k < 26; ++k) {
      known.each_A[k] = unsure * random.Uniform();
      known.value_A[k] =
          law.Current(data.voltage_V[k]) + known.each_A[k] * (2 * random.Uniform() - 1);
    }
    known.largest_light_A = 1;
    known.dark_bound = {3, data.reference_voltage_V};
    const std::vector<double> below(data.voltage_V.begin() + 1, data.voltage_V.end());
    std::vector<double> above = below;
    for (double& v : above) v += 0.002 * random.Uniform();
    const auto ranges = BoundSlopes(known, {window}, below, above, 1e-3);
    double widest = 0;
    for (std::size_t k = 0; k < below.size(); ++k) {
      EXPECT_LE(ranges[k].lower, law.Slope(below[k]) * (1 + 1e-9));
      EXPECT_GE(ranges[k].upper, law.Slope(above[k]) * (1 - 1e-9));
      if (above[k] < 0.55) widest = std::max(widest, ranges[k].upper - ranges[k].lower);
    }
    EXPECT_LT(widest, 2 + 1000 * unsure) << "they say something";
  }
}

// Only some of the many points are bounded individually; the bounds of the others follow from them.
TEST(SlopeBounds, HoldBetweenThePointsThatAreBounded) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 1, 2);
  Mixture mixture;
  mixture.linear = Eigen::Vector2d(0.765, 0.02);
  mixture.atoms = {{0.9 * window.lower + 0.1 * window.upper, 0.3}, {window.upper, 0.45}};
  const MixtureLaw law(data, mixture);
  constexpr int kPoints = 300;
  KnownValues known;
  known.voltage_V.setLinSpaced(kPoints, -0.1, 0.6);
  known.value_A.resize(kPoints);
  for (int k = 0; k < kPoints; ++k) known.value_A[k] = law.Current(known.voltage_V[k]);
  known.each_A = Eigen::VectorXd::Constant(kPoints, 1e-6);
  known.shared = known.common_A = Eigen::VectorXd::Zero(kPoints);
  known.largest_light_A = 1;
  known.dark_bound = {3, 0.6};
  std::vector<double> below(known.voltage_V.begin(), known.voltage_V.end());
  std::vector<double> above = below;
  for (double& v : below) v -= 1e-4;
  for (double& v : above) v += 1e-4;
  const auto ranges = BoundSlopes(known, {window}, below, above, 1e-3);
  ASSERT_EQ(ranges.size(), below.size());
  for (int k = 0; k < kPoints; ++k) {
    EXPECT_LE(ranges[k].lower, law.Slope(below[k]) * (1 + 1e-9)) << k;
    EXPECT_GE(ranges[k].upper, law.Slope(above[k]) * (1 - 1e-9)) << k;
    if (above[k] < 0.4) continue;
    EXPECT_LT(ranges[k].upper / ranges[k].lower, 1.2) << k;
  }
}

TEST(MixtureLaw, SolvesForTheCurrent) {
  const IvCurve curve = Shipped("pwp201");
  const MixtureData data = DataOf(curve);
  const Window window = WindowOf(curve, 0.05, 2);
  for (const double u : {window.lower, 0.3 * window.upper, window.upper}) {
    Mixture mixture;
    mixture.linear = Eigen::Vector2d(1.03, 1e-3);
    mixture.atoms = {{u, 0.9}};
    const MixtureLaw law(data, mixture);
    for (const double v : {-5.0, 0.0, 10.0, 16.0, 20.0, 40.0}) {
      const double current = law.Solve(v, 1.2);
      const double vd = v + 1.2 * current;
      EXPECT_NEAR(current, law.Current(vd), 1e-13 * (1 + law.Slope(vd)) * (1 + std::fabs(v))) << v;
    }
    constexpr double kStep = 1e-6;
    const double slope = (law.Current(16 - kStep) - law.Current(16 + kStep)) / (2 * kStep);
    EXPECT_NEAR(law.Slope(16) / slope, 1, 1e-5);
  }
}

TEST(NoneCompetes, WhereTheResistanceTurnsTheOrderOfPoints) {
  const IvCurve curve = Shipped("rtc_france");
  const MixtureData data = DataOf(curve);
  const double half = 0.5 * 26 * 7.73e-4 * 7.73e-4;
  EXPECT_FALSE(NoneCompetes(data, 0.0365, half));
  EXPECT_TRUE(NoneCompetes(data, 0.3, half));
  EXPECT_FALSE(NoneCompetes(data, 0.3, kInfinity));
}

}  // namespace
}  // namespace lyrefit
