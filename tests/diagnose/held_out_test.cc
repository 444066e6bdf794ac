#include "lyrefit/diagnose/describe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "synthetic_data.h"

namespace lyrefit {
namespace {

std::set<int> Distinct(const std::vector<int>& folds) { return {folds.begin(), folds.end()}; }

TEST(MakeFoldsTest, SpreadsShortBlocksOverASweep) {
  const SyntheticData made = OnTheData(SyntheticCurve({}));  // 60 readings
  const std::vector<int> folds = MakeFolds(made.measurement.readings, 10);
  ASSERT_EQ(folds.size(), 60U);
  EXPECT_EQ(Distinct(folds).size(), 10U);
  for (std::size_t k = 0; k < folds.size(); k += 2) EXPECT_EQ(folds[k], folds[k + 1]);
  for (int fold = 0; fold < 10; ++fold) {
    EXPECT_EQ(std::count(folds.begin(), folds.end(), fold), 6);
  }
  // A fold never covers a whole region of the curve: its readings lie at three places.
  EXPECT_EQ(folds[0], folds[20]);
  EXPECT_EQ(folds[0], folds[40]);
}

TEST(MakeFoldsTest, LeavesWholeCurvesOfAFamilyOut) {
  std::vector<IvCurve> curves;
  for (const double irradiance : {200.0, 400.0, 600.0, 800.0, 1000.0}) {
    Recipe recipe;
    recipe.irradiance_W_m2 = irradiance;
    recipe.points = 12;
    curves.push_back(SyntheticCurve(recipe));
  }
  const SyntheticData made = OnTheData(SetOf(curves));
  const std::vector<int> folds = MakeFolds(made.measurement.readings, 10);
  for (std::size_t k = 0; k < folds.size(); ++k) {
    EXPECT_EQ(folds[k], made.measurement.readings.points[k].curve);
  }
  const std::vector<int> three = MakeFolds(made.measurement.readings, 3);
  EXPECT_EQ(Distinct(three).size(), 3U);
}

TEST(MakeFoldsTest, LeavesWholeSweepsOutWhereThereAreThree) {
  Recipe recipe;
  recipe.and_back = true;
  IvCurve curve = SyntheticCurve(recipe);  // up and down: two sweeps
  EXPECT_FALSE(LeavesSweepsOut(OnTheData(curve).measurement.readings));
  const IvCurve again = curve;
  curve.voltage_V.insert(curve.voltage_V.end(), again.voltage_V.begin(), again.voltage_V.end());
  curve.current_A.insert(curve.current_A.end(), again.current_A.begin(), again.current_A.end());
  const SyntheticData made = OnTheData(curve);
  const Readings& readings = made.measurement.readings;
  ASSERT_TRUE(LeavesSweepsOut(readings));
  const std::vector<int> folds = MakeFolds(readings, 10);
  EXPECT_EQ(Distinct(folds).size(), 4U);
  for (std::size_t k = 0; k < folds.size(); ++k) EXPECT_EQ(folds[k], readings.points[k].segment);
}

TEST(MakeFoldsTest, FewReadingsMakeFewFolds) {
  Recipe recipe;
  recipe.points = 7;
  const SyntheticData made = OnTheData(SyntheticCurve(recipe));
  const std::vector<int> folds = MakeFolds(made.measurement.readings, 10);
  EXPECT_EQ(Distinct(folds).size(), 4U);
  EXPECT_EQ(*std::max_element(folds.begin(), folds.end()), 3);
}

// Held-out gain of a present cause, by the steps of a diagnosis.
TEST(MeasureHeldOutTest, SeesTheGainOfWhatIsThere) {
  IvCurve curve = SyntheticCurve({});
  for (std::size_t k = 30; k < curve.size(); ++k) curve.current_A[k] += 0.1;
  const SyntheticData made = OnTheData(curve);
  const Measurement& measurement = made.measurement;
  SelectOptions options;
  options.candidates = {FindEffect("irr_step"), FindEffect("outliers")};
  const std::vector<char> used(measurement.readings.points.size(), 1);
  const Selection selection = SelectCauses(measurement, used, 0, options);
  const HeldOutErrors one = MeasureHeldOut(measurement, options, selection, 10, 1);
  const HeldOutErrors two = MeasureHeldOut(measurement, options, selection, 10, 2);
  EXPECT_EQ(one.folds, 10);
  // The gain is incomplete: where the reading at the step is held out, the position of the step is
  // uncertain.
  EXPECT_LT(one.after_A, 0.7 * one.before_A);
  EXPECT_TRUE(one.gained());
  EXPECT_GT(one.gain_error_A2, 0);
  EXPECT_LT(one.effects_A.at("irr_step"), one.before_A);
  EXPECT_EQ(one.after_A, two.after_A);
  EXPECT_EQ(one.gain_A2, two.gain_A2);
  EXPECT_EQ(one.effects_A, two.effects_A);
}

}  // namespace
}  // namespace lyrefit
