#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/report/documents.h"
#include "synthetic_family.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FamilyReport FitSynthetic(const CurveSet& set, int fit_curves = 0) {
  FamilyOptions options;
  options.individual_fits = false;
  options.folds = 0;
  options.fit_curves = fit_curves;
  auto report = FitFamily(set, options);
  EXPECT_TRUE(report) << report.error().ToString();
  return report ? std::move(*report) : FamilyReport();
}

CurveSet WhiteSet(int curves) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  return SyntheticSet(law, SyntheticTruth(law), ManyPlaces(curves), 60, 2e-3);
}

// A set in which the irradiance of each curve wanders by 3e-3.
CurveSet WanderingSet(int curves) {
  CurveSet set = WhiteSet(curves);
  RandomStream random(9);
  for (IvCurve& curve : set.curves) {
    const double kept = std::exp(-1.0 / static_cast<double>(curve.size()));
    double light = random.Normal();
    for (double& current : curve.current_A) {
      light = kept * light + std::sqrt(1 - kept * kept) * random.Normal();
      current *= 1 + 3e-3 * light;
    }
  }
  return set;
}

TEST(FamilyErrors, OfWanderingLightEachHalfOfTheCurvesAsksForAPath) {
  const FamilyReport report = FitSynthetic(WanderingSet(12));
  ASSERT_TRUE(report.errors.has_value());
  EXPECT_EQ(report.errors->kind, FamilyErrorKind::kPath);
  EXPECT_EQ(report.errors->judge, FamilyErrorJudge::kHalves);
  EXPECT_EQ(report.errors->tested_curves, 12);
  EXPECT_GT(report.errors->gain, 100);
  EXPECT_NEAR(std::log(report.errors->sizes.readings.path / 3e-3), 0, 0.4);
  EXPECT_EQ(report.under_errors.size(), report.estimates.size());
  EXPECT_THAT(FamilyText(report), HasSubstr("each half under the errors of the other half"));
}

TEST(FamilyErrors, CurvesThatWereNotFittedAreAskedFirst) {
  const FamilyReport report = FitSynthetic(WanderingSet(16), 8);
  ASSERT_TRUE(report.errors.has_value());
  EXPECT_EQ(report.errors->judge, FamilyErrorJudge::kHeldOut);
  EXPECT_EQ(report.errors->tested_curves, 8);
  EXPECT_NE(report.errors->kind, FamilyErrorKind::kIndependent);
}

TEST(FamilyErrors, IndependentOnesStayIndependent) {
  const FamilyReport report = FitSynthetic(WhiteSet(12));
  ASSERT_TRUE(report.errors.has_value());
  EXPECT_EQ(report.errors->kind, FamilyErrorKind::kIndependent);
  EXPECT_EQ(report.errors->judge, FamilyErrorJudge::kHalves);
  EXPECT_TRUE(report.under_errors.empty());
}

TEST(FamilyErrors, FewCurvesSpeakForThemselves) {
  const FamilyReport report = FitSynthetic(WanderingSet(5));
  ASSERT_TRUE(report.errors.has_value());
  EXPECT_EQ(report.errors->judge, FamilyErrorJudge::kFitted);
  EXPECT_EQ(report.errors->tested_curves, 0);
}

}  // namespace
}  // namespace lyrefit
