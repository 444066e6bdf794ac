#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_of.h"
#include "lyrefit/family/fit_family.h"
#include "synthetic_family.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FamilyOptions QuickAuto() {
  FamilyOptions options;
  options.individual_fits = options.intervals = options.random_baseline = false;
  options.search.iterations = 20;
  return options;
}

const FamilyCandidate& Chosen(const FamilyReport& report) {
  for (const FamilyCandidate& one : report.candidates) {
    if (one.chosen) return one;
  }
  ADD_FAILURE() << "no law is chosen";
  return report.candidates[0];
}

TEST(FitFamilyAuto, TellsALawThatTheCurvesDoNotFollow) {
  const Translation pvsyst = SyntheticLaw(TranslationLaw::kPvsyst);
  std::vector<double> truth = SyntheticTruth(pvsyst);
  truth[pvsyst.n_slope] = -1.5e-3;
  truth[pvsyst.resistance_shunt] = 60;
  truth[pvsyst.resistance_shunt_dark] = 120;
  std::vector<SyntheticAt> places;
  for (const double g : {1000.0, 700.0, 400.0, 150.0}) {
    for (const double t : {15.0, 40.0, 65.0}) places.push_back({g, t});
  }
  const auto report = FitFamilyAuto(SyntheticSet(pvsyst, truth, places, 40, 1e-3), QuickAuto());
  ASSERT_TRUE(report) << report.error().ToString();
  ASSERT_EQ(report->candidates.size(), 4U);
  EXPECT_EQ(report->translation.spec.law, TranslationLaw::kPvsyst);
  EXPECT_EQ(Chosen(*report).law, TranslationLaw::kPvsyst);
  EXPECT_EQ(Chosen(*report).model, Model::kSingleDiode);
  for (const FamilyCandidate& one : report->candidates) {
    if (one.law != TranslationLaw::kDeSoto) continue;
    EXPECT_GT(one.behind_best, 1);
  }
}

TEST(FitFamilyAuto, KeepsOneDiodeWhereTheSecondIsOfNoUse) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const auto report =
      FitFamilyAuto(SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 40, 3e-3), QuickAuto());
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(Chosen(*report).model, Model::kSingleDiode);
  EXPECT_EQ(report->translation.spec.model, Model::kSingleDiode);
  EXPECT_LT(Chosen(*report).behind_best, 1);
}

TEST(FitFamilyAuto, TakesTheSimplestWhereNothingIsHeldOut) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  FamilyOptions options = QuickAuto();
  options.folds = 0;
  const auto report =
      FitFamilyAuto(SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 30, 1e-3), options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(Chosen(*report).law, TranslationLaw::kDeSoto);
  EXPECT_EQ(Chosen(*report).model, Model::kSingleDiode);
}

TEST(FitFamilyAuto, SaysWhichLawAnOptionDoesNotFit) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const CurveSet set = SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 30, 1e-3);
  FamilyOptions options = QuickAuto();
  options.fixed["mu_gamma"] = 0;
  const auto report = FitFamilyAuto(set, options);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_EQ(report->candidates.size(), 2U);
  EXPECT_THAT(report->assumptions.back(), HasSubstr("desoto dd was not tried: fix: no parameter"));
  options.fixed = {{"nonsense", 1}};
  EXPECT_THAT(MessageOf(FitFamilyAuto(set, options)), HasSubstr("no parameter nonsense"));
}

}  // namespace
}  // namespace lyrefit
