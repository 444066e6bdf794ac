#include "lyrefit/family/fit_individually.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "family/synthetic_family.h"
#include "lyrefit/estimate/fit/fit.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

class FitIndividuallyTest : public testing::Test {
 protected:
  void SetUp() override {
    options_.search.population = 8;
    options_.search.iterations = 6;
    options_.intervals = false;
  }
  const Translation law_ = SyntheticLaw(TranslationLaw::kDeSoto);
  CurveSet set_ = SyntheticSet(law_, SyntheticTruth(law_), kSixPlaces, 14, 1e-3);
  FamilyOptions options_;
};

TEST_F(FitIndividuallyTest, IsAFitOfEveryCurve) {
  options_.intervals = true;
  options_.threads = 2;
  const FamilyReport report = *FitIndividually(set_, options_);
  FitOptions single;
  single.search = options_.search;
  single.random_baseline = false;
  ASSERT_EQ(report.curves.size(), 6U);
  for (int c = 0; c < 6; ++c) {
    const FitReport fit = *Fit(set_.curves[c], single);
    EXPECT_EQ(report.curves[c].id, set_.curves[c].name);
    EXPECT_EQ(report.curves[c].individual_parameters, fit.refined);
    EXPECT_EQ(report.curves[c].individual_rmse.solved_current_A, fit.rmse.refined.solved_current_A);
    EXPECT_EQ(report.curves[c].individual_estimates[0].high_95, fit.estimates[0].high_95);
  }
  EXPECT_TRUE(report.free);
  EXPECT_TRUE(report.usable);
  EXPECT_FALSE(report.interrupted);
}

TEST_F(FitIndividuallyTest, SaysWhichCurvesCannotBeFitted) {
  for (const int broken : {0, 3}) {
    set_.curves[broken].voltage_V.resize(2);
    set_.curves[broken].current_A.resize(2);
  }
  options_.leave_out = {"c2"};
  const FamilyReport report = *FitIndividually(set_, options_);
  ASSERT_EQ(report.curves.size(), 6U);
  for (const int broken : {0, 3}) {
    EXPECT_EQ(report.curves[broken].role, CurveRole::kLeftOut);
    EXPECT_THAT(report.curves[broken].reason, HasSubstr("points"));
    EXPECT_TRUE(report.curves[broken].individual_parameters.empty());
  }
  EXPECT_EQ(report.curves[1].reason, "left out as asked");
  EXPECT_FALSE(report.curves[2].individual_parameters.empty());
  EXPECT_EQ(report.warnings.size(), 2U);
  EXPECT_TRUE(report.usable);
}

TEST_F(FitIndividuallyTest, FailsWhereNoCurveCanBeFitted) {
  options_.fixed["nonsense"] = 1;
  ASSERT_FALSE(FitIndividually(set_, options_));
  EXPECT_THAT(FitIndividually(set_, options_).error().ToString(), HasSubstr("nonsense"));
  options_.fixed.clear();
  options_.leave_out = {"c9"};
  EXPECT_THAT(FitIndividually(set_, options_).error().ToString(), HasSubstr("no curve c9"));
  options_.leave_out.clear();
  set_.curves.clear();
  EXPECT_THAT(FitIndividually(set_, options_).error().ToString(), HasSubstr("at least one curve"));
}

TEST_F(FitIndividuallyTest, StopsWhenAsked) {
  options_.threads = 1;
  const Observer observer = [](const Progress& now) {
    return now.iteration >= 2 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  const FamilyReport report = *FitIndividually(set_, options_, observer);
  EXPECT_TRUE(report.interrupted);
  ASSERT_EQ(report.curves.size(), 6U);
  for (int c = 0; c < 6; ++c) {
    EXPECT_EQ(report.curves[c].individual_parameters.empty(), c >= 2);
    EXPECT_EQ(report.curves[c].reason, c >= 2 ? "interrupted before its turn" : "");
  }
}

}  // namespace
}  // namespace lyrefit
