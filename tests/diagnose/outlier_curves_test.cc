#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "error_of.h"
#include "lyrefit/diagnose/diagnose.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

// Diagnoses unsuitable measurements, with plausibility checks off (`as_is`). The result must be a
// verdict with finite numbers.
Diagnosis DiagnoseOutlier(CurveSet set) {
  for (IvCurve& curve : set.curves) curve.as_is = true;
  DiagnoseOptions options;
  options.folds = 3;
  auto diagnosis = Diagnose(set, options);
  EXPECT_TRUE(diagnosis.has_value()) << diagnosis.error().message;
  if (!diagnosis) return {};
  EXPECT_FALSE(diagnosis->verdict.sentence.empty());
  for (const DiagnosedPoint& point : diagnosis->points) {
    EXPECT_TRUE(std::isfinite(point.before_A) && std::isfinite(point.after_A));
  }
  for (const Cause& cause : diagnosis->verdict.causes) {
    EXPECT_GE(cause.probability, 0);
    EXPECT_LE(cause.probability, 1);
    for (const CauseParameter& parameter : cause.strength) {
      EXPECT_TRUE(std::isfinite(parameter.value)) << cause.id << " " << parameter.symbol;
    }
  }
  return *diagnosis;
}

Diagnosis DiagnoseOutlier(const IvCurve& curve) { return DiagnoseOutlier(SetOf({curve})); }

// The curve with its readings in another order.
IvCurve Reordered(const IvCurve& curve, const std::vector<int>& order) {
  IvCurve result = curve;
  result.voltage_V.clear();
  result.current_A.clear();
  for (const int k : order) {
    result.voltage_V.push_back(curve.voltage_V[k]);
    result.current_A.push_back(curve.current_A[k]);
  }
  return result;
}

TEST(OutlierCurvesTest, WithoutNoise) {
  for (const int cells : {1, 60}) {
    Recipe recipe;
    recipe.noise_A = 0;
    recipe.cells = cells;
    const Diagnosis d = DiagnoseOutlier(SyntheticCurve(recipe));
    EXPECT_THAT(d.warnings, Contains(HasSubstr("almost no noise")));
  }
}

TEST(OutlierCurvesTest, Unsorted) {
  const IvCurve curve = SyntheticCurve({});
  std::vector<int> order(curve.size());
  std::iota(order.begin(), order.end(), 0);
  RandomStream random(4);
  for (std::size_t k = order.size() - 1; k > 0; --k) {
    std::swap(order[k], order[random.Index(static_cast<std::uint32_t>(k + 1))]);
  }
  DiagnoseOutlier(Reordered(curve, order));
}

TEST(OutlierCurvesTest, BackwardsIsTheSameVerdict) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 26; k < curve.size(); ++k) curve.current_A[k] += 0.12;
  std::vector<int> order(curve.size());
  std::iota(order.rbegin(), order.rend(), 0);
  const Diagnosis forward = DiagnoseOutlier(curve),
                  backward = DiagnoseOutlier(Reordered(curve, order));
  ASSERT_EQ(forward.verdict.causes.size(), backward.verdict.causes.size());
  EXPECT_EQ(forward.verdict.causes.front().id, backward.verdict.causes.front().id);
  EXPECT_NEAR(forward.gain.rmse_after_A, backward.gain.rmse_after_A,
              0.02 * forward.gain.rmse_after_A);
}

TEST(OutlierCurvesTest, EveryReadingTwice) {
  const IvCurve curve = SyntheticCurve({});
  std::vector<int> order;
  for (int k = 0; k < static_cast<int>(curve.size()); ++k) order.insert(order.end(), 2, k);
  DiagnoseOutlier(Reordered(curve, order));
}

TEST(OutlierCurvesTest, SevenReadings) {
  Recipe recipe;
  recipe.points = 7;
  DiagnoseOutlier(SyntheticCurve(recipe));
}

TEST(OutlierCurvesTest, NothingButShortCircuit) {
  Recipe recipe;
  recipe.to_V = 0.1;
  DiagnoseOutlier(SyntheticCurve(recipe));
}

TEST(OutlierCurvesTest, ADeadChannelIsRefusedEvenWhereThePersonInsists) {
  for (const double current : {0.0, 5.0}) {
    IvCurve curve = SyntheticCurve({});
    curve.as_is = true;
    for (double& i : curve.current_A) i = current;
    EXPECT_THAT(MessageOf(Diagnose(SetOf({curve}), {})),
                HasSubstr("is this the column of the current"));
  }
}

TEST(OutlierCurvesTest, NothingButNoise) {
  IvCurve curve = SyntheticCurve({});
  RandomStream random(9);
  for (double& i : curve.current_A) i = random.Normal();
  DiagnoseOutlier(curve);
}

TEST(OutlierCurvesTest, CurrentsInTheOtherSign) {
  IvCurve curve = SyntheticCurve({});
  for (double& i : curve.current_A) i = -i;
  DiagnoseOutlier(curve);
}

TEST(OutlierCurvesTest, WrongNumberOfCells) {
  Recipe recipe;
  recipe.cells = 60;
  for (const int cells : {1, 20, 200}) {
    IvCurve curve = SyntheticCurve(recipe);
    curve.conditions.cells_in_series = cells;
    DiagnoseOutlier(curve);
  }
}

TEST(OutlierCurvesTest, MicroampereAndKiloampere) {
  for (const double factor : {1e-7, 1e3}) {
    IvCurve curve = SyntheticCurve({});
    for (double& i : curve.current_A) i *= factor;
    const Diagnosis d = DiagnoseOutlier(curve);
    EXPECT_FALSE(d.verdict.found);
  }
}

TEST(OutlierCurvesTest, TheSameCurveManyTimes) {
  std::vector<IvCurve> curves(4, SyntheticCurve({}));
  DiagnoseOutlier(SetOf(curves));
}

TEST(OutlierCurvesTest, ManyDarkCurves) {
  DiagnoseOutlier(SetOf({SyntheticDarkCurve(1), SyntheticDarkCurve(2), SyntheticDarkCurve(3)}));
}

}  // namespace
}  // namespace lyrefit
