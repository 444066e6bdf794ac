#include "lyrefit/diagnose/average.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/diagnose/law_coordinates.h"
#include "lyrefit/diagnose/measurement.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;

Recipe Long() {
  Recipe recipe;
  recipe.points = 1500;
  return recipe;
}

Diagnosis DiagnosedQuickly(const IvCurve& curve) {
  return DiagnoseOrFail(curve, Quick(LaboratoryOptions()));
}

// Each average lies on the exact curve at its mean voltage, also where the curve bends, and the
// weights add up to all readings.
TEST(AverageTest, KeepsTheCurveAndLosesNothing) {
  Recipe recipe = Long();
  recipe.noise_A = 0;
  const auto made = MakeMeasurement(SetOf({SyntheticCurve(recipe)}));
  ASSERT_TRUE(made && IsLong(made->readings));
  const Averaged averaged = Average(*made, StartingLaw(made->readings, Model::kSingleDiode), {});
  const std::vector<Reading>& means = averaged.measurement.readings.points;
  EXPECT_LT(means.size(), 350U);
  EXPECT_GT(means.size(), 250U);
  std::size_t counted = 0;
  ASSERT_EQ(averaged.first.size(), means.size() + 1);
  for (std::size_t k = 0; k < means.size(); ++k) {
    const int behind = averaged.first[k + 1] - averaged.first[k];
    counted += behind;
    EXPECT_EQ(means[k].weight, behind);
  }
  EXPECT_EQ(counted, made->readings.points.size());
  IvCurve exact = SyntheticCurve(recipe);
  exact.voltage_V.clear();
  for (const Reading& r : means) exact.voltage_V.push_back(r.voltage);
  const std::vector<double> truth =
      SolveCurrents(MakeDevice(Model::kSingleDiode, exact.conditions),
                    SyntheticParameters(recipe).data(), exact.voltage_V);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_NEAR(means[k].current * made->readings.scale.current_A, truth[k], 1e-6);
  }
}

TEST(AverageTest, ALongCleanCurveIsCleanAndItsNoiseThatOfItsReadings) {
  const Diagnosis d = DiagnosedQuickly(SyntheticCurve(Long()));
  EXPECT_THAT(Ids(d), IsEmpty()) << d.verdict.sentence;
  EXPECT_EQ(d.points.size(), 1500U);
  EXPECT_NEAR(d.points[700].sigma_A, 0.004, 0.0004);
  EXPECT_NEAR(d.gain.rmse_before_A, 0.004, 0.0004);
}

TEST(AverageTest, HeldOutErrorsAreThoseOfReadings) {
  DiagnoseOptions options;
  options.folds = 3;
  const auto d = Diagnose(SyntheticCurve(Long()), options);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR(d->gain.held_out_before_A, 0.004, 0.0004);
}

TEST(AverageTest, OneWrongReadingAmongManyIsFound) {
  IvCurve curve = SyntheticCurve(Long());
  curve.current_A[611] += 0.05;
  const Diagnosis d = DiagnosedQuickly(curve);
  ASSERT_THAT(Ids(d), Contains("outliers"));
  EXPECT_THAT(d.verdict.causes.front().points, Contains(611));
}

TEST(AverageTest, AStepInALongCurveIsFound) {
  IvCurve curve = SyntheticCurve(Long());
  for (std::size_t k = 600; k < curve.size(); ++k) curve.current_A[k] += 0.02;
  const Diagnosis d = DiagnosedQuickly(curve);
  ASSERT_THAT(Ids(d), Contains("irr_step"));
  EXPECT_LT(d.gain.rmse_after_A, 0.0043);
}

Recipe VeryLong() {
  Recipe recipe;
  recipe.points = 100000;
  return recipe;
}

TEST(AverageTest, ACleanCurveOfAHundredThousandReadingsIsClean) {
  const Diagnosis d = DiagnosedQuickly(SyntheticCurve(VeryLong()));
  EXPECT_THAT(Ids(d), IsEmpty()) << d.verdict.sentence;
  EXPECT_FALSE(d.verdict.unexplained);
  ASSERT_EQ(d.points.size(), 100000U);
  EXPECT_NEAR(d.points[70000].sigma_A, 0.004, 1e-4);
  EXPECT_NEAR(d.gain.rmse_before_A, 0.004, 1e-4);
  EXPECT_NEAR(d.evidence.misfit_ratio, 1, 0.02);
}

// A hundred times as many readings make the standard errors ten times smaller.
TEST(AverageTest, ManyReadingsLeaveLessOpen) {
  Recipe few = VeryLong();
  few.points = 1000;
  const Diagnosis many = DiagnosedQuickly(SyntheticCurve(VeryLong()));
  const Diagnosis less = DiagnosedQuickly(SyntheticCurve(few));
  for (const int k : {0, 2, 3}) {  // Iph, n, Rs
    const double ratio = less.gain.shifts[k].standard_error / many.gain.shifts[k].standard_error;
    EXPECT_NEAR(ratio, 10, 1.5) << many.gain.shifts[k].symbol;
  }
}

// The step is located to the reading, wherever it lies within an average, in laboratory mode and in
// field mode.
TEST(AverageTest, AStepAmongAHundredThousandReadingsIsFoundAtItsReading) {
  constexpr int kStep = 40123;
  for (const DiagnoseOptions& options : {LaboratoryOptions(), DiagnoseOptions()}) {
    IvCurve curve = SyntheticCurve(VeryLong());
    for (std::size_t k = kStep; k < curve.size(); ++k) curve.current_A[k] += 0.16;
    const Diagnosis d = DiagnoseOrFail(curve, Quick(options));
    ASSERT_THAT(Ids(d), testing::ElementsAre("irr_step")) << d.verdict.sentence;
    EXPECT_LT(d.gain.rmse_after_A, 0.0045);
    EXPECT_LT(std::fabs(d.points[kStep].after_A - curve.current_A[kStep]), 0.02);
    EXPECT_LT(std::fabs(d.points[kStep - 1].after_A - curve.current_A[kStep - 1]), 0.02);
  }
}

TEST(AverageTest, NoAverageGoesOverAJump) {
  constexpr int kJump = 40123;
  IvCurve curve = SyntheticCurve(VeryLong());
  for (std::size_t k = kJump; k < curve.size(); ++k) curve.current_A[k] += 0.02;
  const auto made = MakeMeasurement(SetOf({curve}));
  ASSERT_TRUE(made);
  const Averaged averaged = Average(*made, StartingLaw(made->readings, Model::kSingleDiode), {});
  const auto next = std::lower_bound(averaged.first.begin(), averaged.first.end(), kJump - 3);
  ASSERT_NE(next, averaged.first.end());
  EXPECT_NEAR(*next, kJump, 3);
  EXPECT_LT(averaged.first.size(), 330U);
}

// Readings in random order are sorted into one sweep, and the diagnosis warns of it.
TEST(AverageTest, ReadingsInNoOrderAreOneSweep) {
  IvCurve curve = SyntheticCurve({});
  std::vector<std::pair<double, double>> readings;
  for (std::size_t k = 0; k < curve.size(); ++k) {
    readings.emplace_back(curve.voltage_V[k], curve.current_A[k]);
  }
  std::mt19937 shuffler(5);
  for (std::size_t k = readings.size() - 1; k > 0; --k) {
    std::swap(readings[k], readings[shuffler() % (k + 1)]);
  }
  for (std::size_t k = 0; k < curve.size(); ++k) {
    std::tie(curve.voltage_V[k], curve.current_A[k]) = readings[k];
  }
  const Diagnosis d = DiagnosedQuickly(curve);
  EXPECT_THAT(Ids(d), IsEmpty()) << d.verdict.sentence;
  EXPECT_THAT(d.warnings, Contains(testing::HasSubstr("in no order of voltage")));
  EXPECT_EQ(d.evidence.kind.rfind("one sweep", 0), 0U) << d.evidence.kind;
}

}  // namespace
}  // namespace lyrefit
