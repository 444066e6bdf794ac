#include "lyrefit/estimate/refine/active_set.h"

#include <gtest/gtest.h>

#include <cmath>

#include "estimate/refine/decay_model.h"
#include "lyrefit/estimate/refine/profile.h"
#include "lyrefit/estimate/refine/spread.h"

namespace lyrefit {
namespace {

// Derivative of the mean square with respect to *x, which must be a number of `point`; central
// difference.
double GradientAt(const FitModel& model, const FitPoint& point, double* x) {
  const double middle = *x, step = 1e-6;
  *x = middle + step;
  const double up = model.MeanSquare(point);
  *x = middle - step;
  const double down = model.MeanSquare(point);
  *x = middle;
  return (up - down) / (2 * step);
}

TEST(RefineModel, FitsAModelOfOnesOwnWithTheUnknownsOfItsBlocks) {
  const Decay model(1);
  const RefineEnd end = RefineModel(model, {{0.5, 3}, {0, 0}});
  EXPECT_TRUE(end.converged);
  EXPECT_LT(end.projected_gradient, 1e-8);
  EXPECT_NEAR(end.p[0], 2, 0.02);
  EXPECT_NEAR(end.p[1], 0.7, 0.02);
  EXPECT_NEAR(end.local[1] - end.local[0], 0.1, 4 * kDecayNoise);
  EXPECT_NEAR(std::sqrt(end.mean_square), kDecayNoise, 0.2 * kDecayNoise);
}

TEST(RefineModel, HoldsAtABoundExactlyAndFitsTheRest) {
  const Decay model(1, 0.9);
  const RefineEnd end = RefineModel(model, {{0.5, 3}, {0, 0}});
  EXPECT_EQ(end.p[1], 0.9);
  EXPECT_TRUE(end.active[1]);
  EXPECT_FALSE(end.active[0]);
  EXPECT_LT(end.projected_gradient, 1e-8);
  FitPoint point = end;
  EXPECT_NEAR(GradientAt(model, point, &point.p[0]), 0, 1e-9);
  EXPECT_NEAR(GradientAt(model, point, &point.local[1]), 0, 1e-9);
  EXPECT_GT(GradientAt(model, point, &point.p[1]), 1e-6);
}

TEST(RefineModel, LetsGoWhatBeginsAtABoundAndWantsBack) {
  const Decay model(1);
  const RefineEnd free = RefineModel(model, {{0.5, 3}, {0, 0}});
  const RefineEnd end = RefineModel(model, {{10, 0}, {0, 0}});
  EXPECT_NEAR(end.mean_square / free.mean_square, 1, 1e-10);
}

TEST(RefineModel, EndsWhereNothingMoreIsAskedFor) {
  const Decay model(1);
  RefineOptions options;
  options.target = 1e-2;
  const RefineEnd end = RefineModel(model, {{0.5, 3}, {0, 0}}, options);
  EXPECT_LE(end.mean_square, 1e-2);
  EXPECT_FALSE(end.converged);
}

TEST(RefineModel, HasTheSpreadOfRepeatedMeasurements) {
  constexpr int kRepeats = 300;
  double sum[3] = {}, squares[3] = {}, claimed[3] = {};
  for (int run = 0; run < kRepeats; ++run) {
    const Decay model(run);
    const RefineEnd end = RefineModel(model, {{2, 0.7}, {0, 0.1}});
    const Spread spread = FindSpread(model, end, end.active, kDecayNoise * kDecayNoise);
    const double value[] = {end.p[0], end.p[1], end.local[0]};
    const double error[] = {spread.standard_error[0], spread.standard_error[1],
                            spread.local_error[0]};
    for (int i = 0; i < 3; ++i) {
      sum[i] += value[i] / kRepeats;
      squares[i] += value[i] * value[i] / kRepeats;
      claimed[i] += error[i] / kRepeats;
    }
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(claimed[i] / std::sqrt(squares[i] - sum[i] * sum[i]), 1, 0.15) << i;
  }
}

TEST(RefineModel, IsProfiledLikeAnyOther) {
  const Decay model(3);
  const RefineEnd best = RefineModel(model, {{2, 0.7}, {0, 0.1}});
  const double variance = kDecayNoise * kDecayNoise, t = 2;
  const Spread spread = FindSpread(model, best, best.active, variance);
  const auto refit = [&](double value) {
    Decay held = model;
    held.Fix(1, value);
    FitPoint at = best;
    at.p[1] = value;
    return RefineModel(held, at);
  };
  for (const bool upper : {false, true}) {
    const ProfileSide side = FindProfileSide(
        model, best, {1, upper, t, variance, spread.standard_error[1]}, RefineOptions());
    EXPECT_TRUE(side.settled);
    const double risen = refit(side.value).mean_square - best.mean_square;
    EXPECT_NEAR(std::sqrt(risen * 2 * kDecayPoints / variance), t, 0.01 * t);
    EXPECT_EQ(side.value > best.p[1], upper);
  }
}

}  // namespace
}  // namespace lyrefit
