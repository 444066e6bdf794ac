#include "lyrefit/estimate/fit/reading_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/refine/coarsen.h"
#include "repeats.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

std::vector<double> Ramp(int readings, double to) {
  std::vector<double> values;
  for (int k = 0; k < readings; ++k) values.push_back(to * k / (readings - 1));
  return values;
}

TEST(GroupNeighbours, LeavesAFewHundredReadingsAlone) {
  EXPECT_EQ(GroupNeighbours(Ramp(kFewPoints, 40), 40), EachAlone(kFewPoints));
}

TEST(GroupNeighbours, MakesAFewHundredOfManyAndNoWideOnes) {
  std::vector<double> voltage = Ramp(20000, 40);
  const std::vector<double> again = voltage;
  voltage.insert(voltage.end(), again.begin(), again.end());  // second sweep from 0 V
  const std::vector<int> first = GroupNeighbours(voltage, 40);
  EXPECT_EQ(first.front(), 0);
  EXPECT_EQ(first.back(), 40000);
  EXPECT_NEAR(static_cast<double>(first.size()), kFewPoints, 10);
  for (std::size_t g = 0; g + 1 < first.size(); ++g) {
    ASSERT_LT(first[g], first[g + 1]);
    EXPECT_LE(std::fabs(voltage[first[g + 1] - 1] - voltage[first[g]]), 0.4);
  }
}

// The shape for averages gives the covariance of averages that follows exactly from the covariance
// of all readings.
TEST(AverageShape, HasTheCovarianceOfMeans) {
  constexpr int kReadings = 1200, kOfEach = 3;
  constexpr double kPath = 2e-3;
  ErrorShape shape;
  const std::vector<double> position = Ramp(kReadings, 1);
  std::vector<int> first;
  for (int k = 0; k < kReadings; ++k) {
    shape.current.push_back(1 + 0.5 * std::sin(0.01 * k));
    shape.voltage.push_back(0);
    shape.path.push_back(8);
    shape.position.push_back(position[k]);
    shape.chain.push_back(0);
    if (k % kOfEach == 0) first.push_back(k);
  }
  first.push_back(kReadings);
  const ErrorSizes sizes = {1e-4, 0, kPath};
  const int groups = kReadings / kOfEach;
  RowMatrix unit = RowMatrix::Zero(groups, 3);
  const int at[] = {0, groups / 2, groups - 2};
  for (int c = 0; c < 3; ++c) unit(at[c], c) = 1;
  const RowMatrix found = CovarianceTimes(MakeErrorModel(AverageShape(first, shape), sizes), unit);

  RowMatrix spread = RowMatrix::Zero(kReadings, 3);  // weights of the readings in a mean
  for (int c = 0; c < 3; ++c)
    spread.middleRows(first[at[c]], kOfEach).col(c).setConstant(1.0 / kOfEach);
  const RowMatrix exact = AverageRows(first, CovarianceTimes(MakeErrorModel(shape, sizes), spread));
  // The part of the error that neighbours do not share, 1e-3 of the covariance, is not averaged
  // exactly.
  EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 2e-6 * exact.maxCoeff());
}

// The voltage noise is larger than the voltage steps.
TEST(AverageNeighbours, OfALongSweepEverySizeIsFound) {
  IvCurve curve = WanderingCurve(3, 30000);
  RandomStream random(4);
  for (double& current : curve.current_A) current += 2e-3 * random.Normal();
  for (const ErrorKind kind : {ErrorKind::kWhite, ErrorKind::kField}) {
    FitOptions options;
    options.errors = {kind, {}, kind == ErrorKind::kWhite ? "white" : "field"};
    const auto report = Fit(curve, options);
    ASSERT_TRUE(report && report->errors);
    const double voc = report->measured.open_circuit_voltage_V;
    EXPECT_NEAR(report->errors->sizes.current_A / 2e-3, 1, 0.03);
    EXPECT_NEAR(report->errors->sizes.voltage_V / (3e-4 * voc), 1, 0.05);
    EXPECT_NEAR(report->errors->sizes.path / 1e-3, 1, 0.25);
    EXPECT_TRUE(report->errors->believed);
  }
}

TEST(AverageNeighbours, WeighingDenseReadingsIsBetterThanNotAndItsIntervalsHold) {
  SKIP_IF_SANITIZED();
  constexpr int kCurves = Repeats(40);
  int covered = 0;
  double plain = 0, weighed = 0;
  for (int seed = 0; seed < kCurves; ++seed) {
    const IvCurve curve = WanderingCurve(seed, 6000);
    FitOptions options;
    options.intervals = Intervals::kSymmetric;
    const auto white = Fit(curve, options);
    options.errors = {ErrorKind::kField, {}, "field"};
    const auto field = Fit(curve, options);
    ASSERT_TRUE(white && field);
    // long path: only differences between neighbours are determined
    const ErrorSizes& sizes = field->errors->sizes;
    EXPECT_NEAR(std::log(sizes.path / std::sqrt(sizes.length) / 1e-3), 0, 0.3);
    EXPECT_EQ(field->residual_A.size(), curve.size());
    plain += std::pow(white->refined[2] - kSingleTruth[2], 2);
    weighed += std::pow(field->refined[2] - kSingleTruth[2], 2);
    for (int i = 0; i < 5; ++i) {
      const Estimate& e = field->estimates[i];
      covered += e.low_95 <= kSingleTruth[i] && kSingleTruth[i] <= e.high_95 ? 1 : 0;
    }
  }
  EXPECT_LT(weighed, 0.6 * plain);
  EXPECT_GT(covered, 0.9 * 5 * kCurves);
}

}  // namespace
}  // namespace lyrefit
