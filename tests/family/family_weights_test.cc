#include "lyrefit/family/joint_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/report/documents.h"
#include "quick.h"
#include "repeats.h"
#include "synthetic_family.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// Noise of one size for all curves or, with `relative`, in proportion to the Isc of each curve.
CurveSet NoisySet(bool relative, std::uint64_t seed) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  CurveSet set = SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 40, 0, seed);
  RandomStream random(seed);
  for (IvCurve& curve : set.curves) {
    const double isc = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
    for (double& current : curve.current_A) {
      current += 1e-3 * (relative ? isc : 3.8) * random.Normal();
    }
  }
  return set;
}

FamilyReport Fit(const CurveSet& set, FamilyWeights weights) {
  FamilyOptions options = Quick();
  options.weights = weights;
  auto report = FitFamily(set, options);
  EXPECT_TRUE(report) << report.error().ToString();
  return report ? std::move(*report) : FamilyReport();
}

TEST(SettleWeights, TakesWhatTheResidualsSpeakFor) {
  SKIP_IF_SANITIZED();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FamilyReport one_size = Fit(NoisySet(false, seed), FamilyWeights::kAuto);
    EXPECT_EQ(one_size.weights, FamilyWeights::kEqual);
    ASSERT_TRUE(one_size.weights_gain);
    EXPECT_LT(*one_size.weights_gain, -20);
    const FamilyReport relative = Fit(NoisySet(true, seed), FamilyWeights::kAuto);
    EXPECT_EQ(relative.weights, FamilyWeights::kIsc);
    ASSERT_TRUE(relative.weights_gain);
    EXPECT_GT(*relative.weights_gain, 20);
  }
}

// The automatically selected weights give the result of a fit with these weights requested.
TEST(SettleWeights, FitsWithTheWeightsItTakes) {
  for (const bool relative : {false, true}) {
    const CurveSet set = NoisySet(relative, 1);
    const FamilyReport taken = Fit(set, FamilyWeights::kAuto);
    const FamilyReport told = Fit(set, relative ? FamilyWeights::kIsc : FamilyWeights::kEqual);
    EXPECT_FALSE(told.weights_gain);
    ASSERT_EQ(taken.estimates.size(), told.estimates.size());
    for (std::size_t i = 0; i < told.estimates.size(); ++i) {
      const Estimate &a = taken.estimates[i], &b = told.estimates[i];
      if (b.fixed) continue;
      EXPECT_NEAR(a.refined, b.refined, 1e-4 * b.standard_error + 1e-12) << b.info.name;
      EXPECT_NEAR(a.standard_error / b.standard_error, 1, 1e-4) << b.info.name;
    }
  }
}

TEST(SettleWeights, SaysWhichAndWhy) {
  const std::string text = FamilyText(Fit(NoisySet(true, 1), FamilyWeights::kAuto));
  EXPECT_THAT(text, HasSubstr("relative to the Isc of each curve"));
  EXPECT_THAT(text, HasSubstr("the residuals speak for errors in proportion to"));
  EXPECT_THAT(text, HasSubstr("(2 ln likelihood +"));
  EXPECT_THAT(FamilyText(Fit(NoisySet(false, 1), FamilyWeights::kAuto)),
              HasSubstr("every point alike"));
}

// If the law deviates from the curves in proportion to their irradiance, the residuals contain no
// information on noise.
TEST(SettleWeights, KeepsEqualWeightsWhereTheLawMisses) {
  CurveSet set = NoisySet(true, 1);
  for (std::size_t c = 0; c < set.curves.size(); ++c) {
    IvCurve& curve = set.curves[c];
    const double off = c % 2 == 0 ? 0.01 : -0.01;
    for (double& current : curve.current_A) current *= 1 + off;
  }
  const FamilyReport report = Fit(set, FamilyWeights::kAuto);
  EXPECT_EQ(report.weights, FamilyWeights::kEqual);
  ASSERT_TRUE(report.weights_gain);
  EXPECT_TRUE(std::isnan(*report.weights_gain));
  EXPECT_THAT(FamilyText(report), HasSubstr("the residuals are more than noise"));
}

TEST(SettleWeights, LeavesStatedErrorsAndExactReadingsAlone) {
  CurveSet set = NoisySet(true, 1);
  for (IvCurve& curve : set.curves) curve.sigma_A.assign(curve.size(), 1e-3);
  EXPECT_FALSE(Fit(set, FamilyWeights::kAuto).weights_gain);
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const CurveSet exact = SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 40, 0);
  EXPECT_FALSE(Fit(exact, FamilyWeights::kAuto).weights_gain);
}

}  // namespace
}  // namespace lyrefit
