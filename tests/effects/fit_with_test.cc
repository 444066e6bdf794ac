#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "module_with.h"
#include "repeats.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

TEST(FitWith, FindsAShadeAndTheDeviceBehindIt) {
  SimulateOptions options = Module();
  options.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  fit.with = {{FindEffect("shading"), {}}};
  const auto report = Fit(*curve, fit);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_TRUE(report->usable) << report->not_usable_because;
  EXPECT_EQ(report->causes, std::vector<std::string>{"shading"});
  EXPECT_NEAR(report->rmse.refined.solved_current_A, 0.004, 0.001);
  EXPECT_TRUE(std::isnan(report->rmse.refined.measured_current_A));
  EXPECT_LT(report->rmse.refined.solved_current_A, report->rmse.searched.solved_current_A);
  for (const auto& [symbol, truth] :
       {std::pair{"shading.d", 0.4}, {"shading.w", 1.0 / 3}, {"Iph", 8.2}, {"Rs", 0.25}}) {
    const Estimate& e = Find(*report, symbol);
    EXPECT_NEAR(e.refined, truth, 5 * e.standard_error + 1e-9) << symbol;
    EXPECT_LT(e.low_95, e.refined) << symbol;
    EXPECT_GT(e.high_95, e.refined) << symbol;
    EXPECT_NE(e.interval, IntervalMethod::kNone) << symbol;
  }
}

TEST(FitWith, GivesTheSameBitsOnAnyNumberOfThreads) {
  SimulateOptions options = Module();
  options.with = {{FindEffect("mismatch"), {{"d", {0.1, 0.1}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve);
  FitOptions fit;
  fit.with = {{FindEffect("mismatch"), {}}};
  fit.threads = 1;
  const auto one = Fit(*curve, fit);
  fit.threads = 4;
  const auto four = Fit(*curve, fit);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->refined, four->refined);
  EXPECT_EQ(one->searched, four->searched);
  for (std::size_t i = 0; i < one->estimates.size(); ++i) {
    EXPECT_EQ(one->estimates[i].low_95, four->estimates[i].low_95);
    EXPECT_EQ(one->estimates[i].high_95, four->estimates[i].high_95);
  }
}

TEST(FitWith, HoldsWhatItIsTold) {
  SimulateOptions options = Module();
  options.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve);
  FitOptions fit;
  fit.with = {{FindEffect("shading"), {{"w", {1.0 / 3, 1.0 / 3}}, {"d", {0.1, 0.3}}}}};
  const auto report = Fit(*curve, fit);
  ASSERT_TRUE(report);
  EXPECT_TRUE(Find(*report, "shading.w").fixed);
  EXPECT_EQ(Find(*report, "shading.w").refined, 1.0 / 3);
  EXPECT_NEAR(Find(*report, "shading.d").refined, 0.3, 1e-12);
  EXPECT_EQ(Find(*report, "shading.d").at_bound, BoundSide::kUpper);
}

TEST(FitWith, HoldsAStrengthThatIsMeasuredByAnotherParameter) {
  SimulateOptions options = Module();
  options.with = {{FindEffect("nonohmic_shunt"), {{"k", {0.5, 0.5}}, {"m", {3, 3}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  fit.with = options.with;
  const auto report = Fit(*curve, fit);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_NEAR(Find(*report, "nonohmic_shunt.k").refined, 0.5, 1e-12);
  EXPECT_NEAR(report->rmse.refined.solved_current_A, 0.004, 0.001);
}

TEST(FitWith, FitsMoreReadingsThanOthersAreThinnedTo) {
  SKIP_IF_SANITIZED();
  SimulateOptions options = Module();
  options.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  options.points = 600;
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  fit.with = {{FindEffect("shading"), {{"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto report = Fit(*curve, fit);
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_NEAR(report->rmse.refined.solved_current_A, 0.004, 0.0005);
  const Estimate& d = Find(*report, "shading.d");
  EXPECT_NEAR(d.refined, 0.4, 5 * d.standard_error + 1e-9);
  EXPECT_EQ(report->residual_A.size(), 600u);
}

TEST(FitWith, LeavesOutliersAsideWhereItIsToldTo) {
  SimulateOptions options = Module();
  options.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  for (const std::size_t k : {10u, 30u, 50u}) curve->current_A[k] += 0.5;
  FitOptions fit;
  fit.with = {{FindEffect("shading"), {{"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto squared = Fit(*curve, fit);
  fit.loss = Loss::kHuber;
  const auto huber = Fit(*curve, fit);
  ASSERT_TRUE(squared && huber);
  const auto error = [](const FitReport& report) {
    return std::fabs(Find(report, "shading.d").refined - 0.4);
  };
  EXPECT_LT(error(*huber), 0.002);
  EXPECT_LT(error(*huber), 0.3 * error(*squared));
}

// A user-defined effect: a shunt that grows with the square of the voltage.
Effect SquareShunt() {
  Effect e;
  e.id = "square_shunt";
  e.title = "shunt that grows with the voltage";
  e.parameters = {Parameter("s", "strength", "current at 1 V of a cell")
                      .Unit("A/V2")
                      .Between(0, 1)
                      .CurrentPower(1)};
  e.junction = [](const auto* p, const auto&, const auto&, const auto& voltage) {
    return -(abs(voltage) * voltage) * p[0];
  };
  e.probes = [](const DataTraits&) { return std::vector<Probe>{{0.02}}; };
  return e;
}

TEST(FitWith, TakesAnEffectOfOnesOwn) {
  const Effect own = SquareShunt();
  SimulateOptions options = Module();
  options.noise_A = 0.001;
  for (int k = 0; k < 80; ++k) options.voltage_V.push_back(-20 + 60.0 * k / 79);
  options.with = {{&own, {{"s", {0.5, 0.5}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  const auto without = Fit(*curve, fit);
  fit.with = {{&own, {}}};
  const auto report = Fit(*curve, fit);
  ASSERT_TRUE(without && report) << report.error().ToString();
  EXPECT_LT(report->rmse.refined.solved_current_A, 0.2 * without->rmse.refined.solved_current_A);
  const Estimate& s = Find(*report, "square_shunt.s");
  EXPECT_LE(s.low_95, 0.5);
  EXPECT_GE(s.high_95, 0.5);
}

// The effect above as a plain function of numbers, differentiated by differences.
Effect PlainSquareShunt() {
  Effect e = SquareShunt();
  e.junction = {};
  e.plain_junction = WithDifferences(
      [](const StageInput& in, double* value) {
        for (int i = 0; i < in.count; ++i) value[i] = -std::fabs(in.x[i]) * in.x[i] * in.p[0];
      },
      {{0, 1}}, false);
  return e;
}

TEST(FitWith, TakesPlainFunctionsForAnEffect) {
  const Effect own = SquareShunt(), plain = PlainSquareShunt();
  SimulateOptions options = Module();
  options.noise_A = 0.001;
  for (int k = 0; k < 80; ++k) options.voltage_V.push_back(-20 + 60.0 * k / 79);
  options.with = {{&own, {{"s", {0.5, 0.5}}}}};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  fit.with = {{&own, {}}};
  const auto expected = Fit(*curve, fit);
  fit.with = {{&plain, {}}};
  const auto found = Fit(*curve, fit);
  ASSERT_TRUE(expected && found) << found.error().ToString();
  EXPECT_NEAR(found->rmse.refined.solved_current_A, expected->rmse.refined.solved_current_A, 1e-12);
  for (std::size_t k = 0; k < expected->refined.size(); ++k) {
    EXPECT_NEAR(found->refined[k] / expected->refined[k], 1, 1e-8) << k;
  }
}

// A suggested point is evaluated once more, for its rank.
TEST(FitWith, BeginsAtTheShapeOfTheCurveIfTheSearchAsksForIt) {
  const std::pair<double, double> third = {1.0 / 3, 1.0 / 3};
  EffectUse use{FindEffect("substrings"), {{"w1", third}, {"w2", third}}};
  SimulateOptions options = Module();
  options.with = {use};
  options.with[0].ranges["d1"] = {0.5, 0.5};
  options.with[0].ranges["d2"] = {0.25, 0.25};
  const auto curve = Simulate(options);
  ASSERT_TRUE(curve) << curve.error().ToString();
  FitOptions fit;
  fit.with = {use};
  fit.intervals = Intervals::kNone;
  const auto plain = Fit(*curve, fit);
  fit.search.algorithm = Algorithm::kMloShape;
  const auto shaped = Fit(*curve, fit);
  ASSERT_TRUE(plain && shaped);
  EXPECT_EQ(plain->curve_evaluations, plain->search.evaluations);
  EXPECT_GT(shaped->curve_evaluations, shaped->search.evaluations);
  EXPECT_LE(shaped->search.trace[0].best, plain->search.trace[0].best);
}

TEST(FitWith, SaysWhatDoesNotGoWithEffects) {
  const auto curve = Simulate(Module());
  ASSERT_TRUE(curve);
  const auto error = [&](const FitOptions& options) {
    const auto report = Fit(*curve, options);
    return report ? "no error" : report.error().ToString();
  };
  FitOptions fit;
  fit.with = {{FindEffect("shading"), {}}};
  fit.objective = Objective::kMeasuredCurrent;
  EXPECT_THAT(error(fit), HasSubstr("fitted to the solved current"));
  fit.objective = Objective::kSolvedCurrent;
  fit.floor = true;
  EXPECT_THAT(error(fit), HasSubstr("a floor is that of diodes alone"));
  fit.floor = false;
  fit.with = {{FindEffect("capacitance"), {}}};
  EXPECT_THAT(error(fit), HasSubstr("needs a sweep up and a sweep down"));
  fit.with = {{FindEffect("nonohmic_shunt"), {{"k", {0.01, 0.02}}}}};
  EXPECT_THAT(error(fit), HasSubstr("expected k=0.01:0.02,m=VALUE, or k left out"));
  fit.with = {{FindEffect("nonohmic_shunt"), {{"k", {0.01, 0.02}}, {"m", {2, 3}}}}};
  EXPECT_THAT(error(fit), HasSubstr("only where m, which k is measured by, is fixed"));
}

}  // namespace
}  // namespace lyrefit
