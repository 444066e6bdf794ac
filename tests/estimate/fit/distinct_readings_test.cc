#include "lyrefit/estimate/fit/prepare_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"
#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The curve with every reading repeated `times` times in a row.
IvCurve Repeated(const IvCurve& curve, int times) {
  IvCurve repeated = curve;
  repeated.voltage_V.clear();
  repeated.current_A.clear();
  for (std::size_t k = 0; k < curve.size(); ++k) {
    repeated.voltage_V.insert(repeated.voltage_V.end(), times, curve.voltage_V[k]);
    repeated.current_A.insert(repeated.current_A.end(), times, curve.current_A[k]);
  }
  return repeated;
}

FitReport FitDistinct(const IvCurve& curve, FitOptions options = {}) {
  options.random_baseline = false;
  auto report = Fit(curve, options);
  EXPECT_TRUE(report) << report.error().ToString();
  return report ? std::move(*report) : FitReport();
}

TEST(DistinctReadings, ExactCopiesAreCountedAndNothingElse) {
  IvCurve curve;
  curve.voltage_V = {0, 1, 0, 1, 1};
  curve.current_A = {5, 4, 5, 4.5, 4};
  const DistinctReadings found = FindDistinctReadings(curve);
  EXPECT_THAT(found.curve.voltage_V, ElementsAre(0, 1, 1));
  EXPECT_THAT(found.curve.current_A, ElementsAre(5, 4, 4.5));
  EXPECT_THAT(found.copies, ElementsAre(2, 2, 1));
  curve.time_s = {0, 1, 2, 3, 4};
  EXPECT_THAT(FindDistinctReadings(curve).copies, IsEmpty());
}

TEST(DistinctReadings, CopiesChangeNoStandardErrorAndNoInterval) {
  const IvCurve once = ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, 3);
  const FitReport one = FitDistinct(once), many = FitDistinct(Repeated(once, 25));
  EXPECT_EQ(many.curve.size(), 25 * once.size());
  EXPECT_EQ(many.criteria.points, static_cast<int>(once.size()));
  EXPECT_NEAR(many.rmse.refined.solved_current_A, one.rmse.refined.solved_current_A, 1e-12);
  EXPECT_NEAR(many.residuals.durbin_watson, one.residuals.durbin_watson, 1e-6);
  EXPECT_EQ(many.errors->believed, one.errors->believed);
  for (int i = 0; i < 5; ++i) {
    const Estimate &a = one.estimates[i], &b = many.estimates[i];
    EXPECT_NEAR(b.refined / a.refined, 1, 1e-6) << i;
    EXPECT_NEAR(b.standard_error / a.standard_error, 1, 1e-4) << i;
    EXPECT_NEAR(b.low_95 / a.low_95, 1, 1e-3) << i;
    EXPECT_NEAR(b.high_95 / a.high_95, 1, 1e-3) << i;
  }
  EXPECT_THAT(many.warnings,
              ::testing::Contains(HasSubstr("1440 of 1500 readings are exact copies")));
}

TEST(DistinctReadings, RepeatedMeasurementsCountEachTime) {
  IvCurve many = Repeated(ModuleCurve(Model::kSingleDiode, kSingleTruth, 0, 1, 40), 25);
  RandomStream random(2);
  for (double& current : many.current_A) current += 4e-3 * random.Normal();
  IvCurve once = ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, 2, 40);
  FitOptions options;
  options.intervals = Intervals::kSymmetric;
  const FitReport one = FitDistinct(once, options), all = FitDistinct(many, options);
  EXPECT_EQ(all.criteria.points, 1000);
  const double ratio = one.estimates[2].standard_error / all.estimates[2].standard_error;
  EXPECT_GT(ratio, 3.5);
  EXPECT_LT(ratio, 7);
}

TEST(DistinctReadings, AsManyParametersAsReadingsHaveNoErrors) {
  FitOptions single, few_effects, twin;
  twin.model = Model::kDoubleDiode;
  const auto spaced = [](int points) {
    return ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, 7, points);
  };
  const struct {
    IvCurve curve;
    FitOptions options;
  } kCases[] = {{spaced(5), single}, {Repeated(spaced(5), 3), single}, {spaced(7), twin}};
  for (const auto& [curve, options] : kCases) {
    const FitReport report = FitDistinct(curve, options);
    EXPECT_THAT(report.no_intervals_because, HasSubstr("different readings fix"));
    for (const Estimate& e : report.estimates) {
      EXPECT_TRUE(std::isnan(e.standard_error)) << e.info.symbol;
      EXPECT_TRUE(std::isnan(e.low_95) && std::isnan(e.high_95)) << e.info.symbol;
      EXPECT_EQ(e.interval, IntervalMethod::kNone);
      EXPECT_FALSE(e.identifiable);
      EXPECT_THAT(e.reason, HasSubstr("different readings fix"));
    }
  }
  const FitReport enough = FitDistinct(spaced(6));
  EXPECT_EQ(enough.no_intervals_because, "");
  EXPECT_THAT(MessageOf(Fit(Repeated(spaced(5), 3), twin)), HasSubstr("5 different points"));
}

}  // namespace
}  // namespace lyrefit
