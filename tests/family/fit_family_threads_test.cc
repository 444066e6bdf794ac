#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <thread>

#include "family/synthetic_family.h"
#include "lyrefit/family/fit_family.h"

namespace lyrefit {
namespace {

// Every number of a report except times.
class Numbers {
 public:
  explicit Numbers(const FamilyReport& report) {
    AddAll(report.searched);
    AddAll(report.refined);
    for (const Estimate& e : report.estimates) {
      AddAll({e.searched, e.refined, e.standard_error, e.low_95, e.high_95});
    }
    Add(report.irradiance_offset_W_m2);
    Add(report.temperature_offset_K);
    for (const Coefficient& c : report.coefficients) Add(c.value);
    for (const Interval& interval : report.jackknife) Add(interval);
    for (const Correlation& c : report.correlations) AddAll({c.value});
    const RmseTable& table = report.rmse;
    for (const RmsePair& pair :
         {table.random_baseline, table.searched, report.searched_all, table.refined}) {
      Add(pair);
    }
    AddAll({report.noise_A, report.refine.projected_gradient, report.reference.max_power_W});
    for (const FamilyCurve& curve : report.curves) {
      Add(curve.irradiance_offset_W_m2);
      Add(curve.temperature_offset_K);
      AddAll(curve.parameters);
      AddAll(curve.residual_A);
      AddAll(curve.individual_parameters);
      Add(curve.rmse);
      Add(curve.individual_rmse);
    }
    if (report.held_out) {
      Add(report.held_out->rmse);
      AddAll({report.held_out->median_rmse_A, report.held_out->median_individual_rmse_A});
    }
    if (report.without_outliers) AddAll(report.without_outliers->shared);
  }
  const std::vector<double>& all() const { return all_; }

 private:
  void AddAll(const std::vector<double>& values) {
    all_.insert(all_.end(), values.begin(), values.end());
  }
  void Add(const Interval& i) { AddAll({i.value, i.standard_error, i.low_95, i.high_95}); }
  void Add(const RmsePair& pair) { AddAll({pair.measured_current_A, pair.solved_current_A}); }
  std::vector<double> all_;
};

FamilyOptions Small() {
  FamilyOptions options;
  options.search.population = 8;
  options.search.iterations = 6;
  options.folds = 2;
  return options;
}

CurveSet SetWithAStranger() {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  std::vector<double> shared = SyntheticTruth(law);
  CurveSet set = SyntheticSet(law, shared, kSixPlaces, 15, 2e-3);
  shared[law.photocurrent] *= 1.2;
  RandomStream random(4);
  set.curves.push_back(SyntheticCurve(law, shared, {500, 25}, 15, 2e-3, &random));
  set.curves.back().name = "stranger";
  set.curves[3].irradiance_known = false;
  return set;
}

TEST(FitFamily, GivesTheSameBitsOnEveryNumberOfThreads) {
  const CurveSet set = SetWithAStranger();
  FamilyOptions options = Small();
  options.temperature_accuracy_K = 1;
  options.threads = 1;
  const std::vector<double> one = Numbers(*FitFamily(set, options)).all();
  for (const int threads : {2, 3}) {
    options.threads = threads;
    const std::vector<double> many = Numbers(*FitFamily(set, options)).all();
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      if (std::isnan(one[k]) && std::isnan(many[k])) continue;  // the sign of NaN is arbitrary
      ASSERT_EQ(std::memcmp(&one[k], &many[k], sizeof(double)), 0) << k << " of " << one.size();
    }
  }
}

TEST(FitFamily, StopsAtEveryStage) {
  const CurveSet set = SetWithAStranger();
  std::set<std::string> stages;
  const Observer listen = [&](const Progress& now) {
    stages.insert(std::string(now.stage));
    return ObserverAction::kContinue;
  };
  const FamilyReport whole = *FitFamily(set, Small(), listen);
  EXPECT_FALSE(whole.interrupted);
  EXPECT_THAT(stages, testing::IsSupersetOf({"search", "curves", "joint fit", "intervals",
                                             "held out", "outlier curves", "jackknife"}));
  for (const std::string& stage : stages) {
    SCOPED_TRACE(stage);
    const Observer stop = [&](const Progress& now) {
      return now.stage == stage ? ObserverAction::kStop : ObserverAction::kContinue;
    };
    const FamilyReport report = *FitFamily(set, Small(), stop);
    EXPECT_TRUE(report.interrupted);
    EXPECT_THAT(report.warnings, testing::Contains(testing::HasSubstr("Interrupted")));
    const std::size_t count = report.translation.parameters.size();
    EXPECT_EQ(report.refined.size(), count);
    EXPECT_TRUE(report.estimates.empty() || report.estimates.size() == count);
    ASSERT_EQ(report.curves.size(), set.curves.size());
    for (const FamilyCurve& row : report.curves) {
      EXPECT_TRUE(row.residual_A.empty() || row.residual_A.size() == row.points);
    }
    EXPECT_TRUE(report.jackknife.empty() || report.jackknife.size() == count);
    EXPECT_EQ(report.usable, !report.estimates.empty());
  }
}

TEST(FitFamily, StopsInTheMiddleOfAJointSolve) {
  const CurveSet set = SetWithAStranger();
  FamilyOptions options = Small();
  options.threads = 1;
  options.temperature_accuracy_K = 1;
  // The fit calls the observer at every step, at most every 50 ms; from the third call on the
  // observer stops the fit.
  for (const std::string stage : {"joint fit", "jackknife"}) {
    int asked = 0;
    const FamilyReport report = *FitFamily(set, options, [&](const Progress& now) {
      std::this_thread::sleep_for(std::chrono::milliseconds(now.stage == stage ? 60 : 0));
      asked += now.stage == stage;
      return asked > 2 ? ObserverAction::kStop : ObserverAction::kContinue;
    });
    EXPECT_EQ(asked, 3) << stage;
    EXPECT_TRUE(report.interrupted);
    EXPECT_EQ(report.refine.termination, stage == "joint fit" ? "interrupted" : "converged");
    EXPECT_TRUE(report.jackknife.empty());
  }
}

TEST(FitFamily, RefusesLessThanNoThreads) {
  FamilyOptions options = Small();
  options.threads = -3;
  EXPECT_THAT(FitFamily(SetWithAStranger(), options).error().message,
              testing::HasSubstr("threads = -3, expected 0"));
}

TEST(FitFamilyAuto, ChoosesTheLawThatPredictsBest) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const CurveSet set = SyntheticSet(law, SyntheticTruth(law), kSixPlaces, 20, 5e-4);
  FamilyOptions options = Small();
  options.individual_fits = options.intervals = options.random_baseline = false;
  const FamilyReport report = *FitFamilyAuto(set, options);
  ASSERT_EQ(report.candidates.size(), 4U);
  EXPECT_EQ(report.translation.spec.law, TranslationLaw::kDeSoto);
  EXPECT_TRUE(report.candidates[0].chosen || report.candidates[1].chosen);
  // Without held-out curves, the simplest law is chosen.
  options.folds = 0;
  EXPECT_TRUE(FitFamilyAuto(set, options)->candidates[0].chosen);
  const Observer stop = [](const Progress&) { return ObserverAction::kStop; };
  EXPECT_TRUE(FitFamilyAuto(set, options, stop)->interrupted);
}

TEST(FitFamily, FitsFiveHundredCurves) {
  const Translation law = SyntheticLaw(TranslationLaw::kDeSoto);
  const std::vector<double> truth = SyntheticTruth(law);
  const CurveSet set = SyntheticSet(law, truth, ManyPlaces(500), 10, 2e-3);
  FamilyOptions options = Small();
  options.individual_fits = false;
  options.irradiance_accuracy = 0.01;
  const FamilyReport report = *FitFamily(set, options);
  EXPECT_EQ(report.refine.termination, "converged");
  EXPECT_NEAR(report.refined[law.n], 1.2, 0.02);
  EXPECT_NEAR(report.noise_A, 2e-3, 2e-4);
}

}  // namespace
}  // namespace lyrefit
