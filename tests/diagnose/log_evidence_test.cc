#include "lyrefit/diagnose/fitted_candidate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "lyrefit/diagnose/law_coordinates.h"
#include "synthetic_data.h"

namespace lyrefit {
namespace {

// A fit of the base model with one more effect.
LawFit FitWith(const SyntheticData& made, const char* id, const std::vector<double>& own) {
  const LawFit base = FitBase(made.weighted, Law());
  Law law;
  law.effects = {FindEffect(id)};
  std::vector<double> start = base.p;
  start.insert(start.end(), own.begin(), own.end());
  return FitLaw(made.weighted, law, start);
}

SyntheticData WithKnownNoise(const IvCurve& curve) {
  SyntheticData made = OnTheData(curve);
  made.weighted.least_variance = 1;
  return made;
}

constexpr double kCentre = -0.08, kWidth = 0.05;

IvCurve WithDip() {
  IvCurve curve = SyntheticCurve({});
  const SyntheticData made = OnTheData(curve);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    const double z = (made.measurement.readings.points[k].x - kCentre) / kWidth;
    curve.current_A[k] -= 0.1 * std::exp(-0.5 * z * z);
  }
  return curve;
}

// A dip at a known moment; its depth is free or known as well.
Effect KnownDip(bool free_depth) {
  Effect dip = *FindEffect("transient");
  for (int k = free_depth ? 1 : 0; k < dip.size(); ++k) dip.parameters[k].searched = true;
  dip.probes = [](const DataTraits&) { return std::vector<Probe>{{0.05, 0.05, 0.05, 0, 2}}; };
  return dip;
}

double EvidenceWith(const SyntheticData& made, const LawFit& base, const Effect& dip,
                    double depth) {
  Law law;
  law.effects = {&dip};
  std::vector<double> start = base.p;
  start.insert(start.end(), {depth, kCentre, kWidth, 0, 2});
  const LawFit fit = FitLaw(made.weighted, law, start);
  EXPECT_TRUE(fit.usable);
  return FindLogEvidence(made.weighted, fit, {}).complete;
}

// Density of Student's t with three degrees of freedom.
double Student3(double z) { return 2 * std::sqrt(3.0) / M_PI / std::pow(1 + z * z / 3, 2) / 3; }

TEST(LogEvidenceTest, IsTheIntegralOverAStrength) {
  const SyntheticData made = WithKnownNoise(WithDip());
  const LawFit base = FitBase(made.weighted, Law());
  const Effect free = KnownDip(true), known = KnownDip(false);
  const double usual = free.parameters.front().usual;
  ASSERT_GT(usual, 0);
  double sum = 0;
  constexpr int kSteps = 200;
  constexpr double kLargest = 0.03;
  for (int k = 0; k <= kSteps; ++k) {
    const double depth = kLargest * k / kSteps;
    sum += std::exp(EvidenceWith(made, base, known, depth)) * Student3(depth / usual) / usual *
           kLargest / kSteps;
  }
  EXPECT_NEAR(EvidenceWith(made, base, free, 0.01), std::log(sum), 0.1);
}

TEST(LogEvidenceTest, GrowsWithWhatACauseExplains) {
  const SyntheticData dip = WithKnownNoise(WithDip());
  const SyntheticData none = WithKnownNoise(SyntheticCurve({}));
  const auto gain = [](const SyntheticData& made) {
    const LawFit base = FitBase(made.weighted, Law());
    const LawFit fit = FitWith(made, "transient", {0.01, kCentre, kWidth, 0, 2});
    return FindLogEvidence(made.weighted, fit, {}).complete -
           FindLogEvidence(made.weighted, base, {}).complete;
  };
  EXPECT_GT(gain(dip), 50);
  EXPECT_LT(gain(none), 0);  // it pays for its freedom
}

TEST(LogEvidenceTest, AnUnknownDepartureExplainsWhatTheLawDoesNot) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 0; k < curve.size(); ++k) curve.current_A[k] += 0.2 * std::sin(0.25 * k);
  const SyntheticData odd = WithKnownNoise(curve), sound = WithKnownNoise(SyntheticCurve({}));
  const auto of = [](const SyntheticData& made) {
    return FindLogEvidence(made.weighted, FitBase(made.weighted, Law()), {1.2e-3, 0.35});
  };
  EXPECT_GT(of(odd).incomplete - of(odd).complete, of(sound).incomplete - of(sound).complete);
  EXPECT_LT(of(sound).incomplete, of(sound).complete);
  EXPECT_GT(of(odd).path, 3 * of(sound).path);
}

TEST(LogEvidenceTest, AParameterAtItsBoundCountsWithThePartInside) {
  // No second diode: its strength is at 0.
  const SyntheticData made = WithKnownNoise(SyntheticCurve({}));
  const LawFit base = FitBase(made.weighted, Law());
  LawFit bound = base;
  bound.law.effects = {FindEffect("nonohmic_shunt")};
  bound.p.insert(bound.p.end(), {0.0, 2.0});
  const double with = FindLogEvidence(made.weighted, bound, {}).complete;
  const double without = FindLogEvidence(made.weighted, base, {}).complete;
  EXPECT_TRUE(std::isfinite(with));
  EXPECT_LT(with, without + 1);
}

TEST(LogSumTest, IsTheLogarithmOfTheSum) {
  EXPECT_NEAR(LogSum(std::log(2), std::log(3)), std::log(5), 1e-12);
  EXPECT_NEAR(LogSum(-1000, -1000), -1000 + std::log(2), 1e-12);
  EXPECT_EQ(LogSum(-HUGE_VAL, 3), 3);
}

}  // namespace
}  // namespace lyrefit
