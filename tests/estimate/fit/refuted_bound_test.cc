#include "lyrefit/estimate/fit/judge_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/read/read_curve.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

FitReport FitOf(const IvCurve& curve, const FitOptions& options = {}) {
  auto report = Fit(curve, options);
  EXPECT_TRUE(report) << report.error().ToString();
  return report ? std::move(*report) : FitReport();
}

const std::vector<double> kSteepTruth = {3.8, 1e-3, 2.7, 0.05, 300};  // n is above its bound

TEST(RefutedBound, LeavesNoIntervalThatHoldsUnderItAlone) {
  for (const double noise_A : {0.0, 1e-3}) {
    const IvCurve curve = ModuleCurve(Model::kSingleDiode, kSteepTruth, noise_A);
    FitOptions stated;
    stated.bounds.overrides["n"] = {1, 2};
    const FitReport report = FitOf(curve, stated);
    EXPECT_EQ(report.estimates[2].at_bound, BoundSide::kUpper);
    EXPECT_THAT(report.no_intervals_because, HasSubstr("n1 = 2, its upper bound"));
    EXPECT_THAT(report.no_intervals_because, HasSubstr("--bound n1=1:8"));
    EXPECT_THAT(report.warnings, Contains(HasSubstr("no intervals: the readings refute n1 = 2")));
    EXPECT_TRUE(report.under_errors.empty());
    for (const Estimate& e : report.estimates) {
      EXPECT_TRUE(std::isnan(e.low_95) && std::isnan(e.standard_error)) << e.info.symbol;
    }
    FitOptions wider;
    wider.bounds.overrides["n"] = {1, 8};
    const FitReport wide = FitOf(curve, wider);
    EXPECT_EQ(wide.no_intervals_because, "");
    EXPECT_NEAR(wide.refined[2], 2.7, 0.1);
  }
}

TEST(RefutedBound, GivesWayIfNobodyStatedIt) {
  const IvCurve curve = ModuleCurve(Model::kSingleDiode, kSteepTruth, 1e-3);
  const FitReport report = FitOf(curve);
  EXPECT_EQ(report.no_intervals_because, "");
  EXPECT_LE(report.estimates[2].low_95, 2.7);
  EXPECT_GE(report.estimates[2].high_95, 2.7);
  EXPECT_THAT(SentencesOf(report.curve.assumptions),
              Contains(HasSubstr("n1 was given room up to 8: the readings refute n1 = 2")));
  FitOptions two;
  two.model = Model::kDoubleDiode;
  EXPECT_LE(FitOf(curve, two).estimates[2].bounds.upper, 2) << "two diodes keep their bounds";
  FitOptions floor;
  floor.floor = true;
  EXPECT_THAT(FitOf(curve, floor).no_intervals_because, HasSubstr("n1 = 2, its upper bound"))
      << "a floor is that of the bounds";
}

// A diode of n 1.3 in the dark, to 1.6 V, of which Rs takes 1.1 V.
TEST(RefutedBound, AnyThatTheUserStatesMayBeRefuted) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1;
  for (int k = 0; k <= 120; ++k) curve.voltage_V.push_back(-0.8 + 0.02 * k);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> truth = {0, 3e-9, 1.3, 8, 4e4};
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  RandomStream random(3);
  for (double& current : curve.current_A) current += 2e-7 * random.Normal();
  const std::pair<const char*, std::pair<double, double>> refuted[] = {
      {"Rs", {0, 5}}, {"Rs", {9, 20}}, {"Is", {0, 1e-10}}, {"Rsh", {10, 2e4}}, {"n", {1.4, 8}}};
  for (const auto& [symbol, range] : refuted) {
    FitOptions stated;
    stated.bounds.overrides[symbol] = range;
    const FitReport report = FitOf(curve, stated);
    EXPECT_THAT(report.no_intervals_because, HasSubstr(std::string("--bound ") + symbol));
    EXPECT_TRUE(std::isnan(report.estimates[2].low_95)) << symbol;
  }
  for (const auto& [symbol, range] :
       {std::pair{"Rs", std::pair{0.0, 20.0}}, std::pair{"Rsh", std::pair{10.0, 1e6}}}) {
    FitOptions stated;
    stated.bounds.overrides[symbol] = range;
    const FitReport report = FitOf(curve, stated);
    EXPECT_EQ(report.no_intervals_because, "") << symbol;
    EXPECT_NEAR(report.refined[2], 1.3, 1e-3) << symbol;
  }
}

TEST(RefutedBound, BelowOneNoJunctionIs) {
  std::vector<double> truth = kSingleTruth;
  truth[1] *= 1e-4;
  truth[2] = 0.8;
  const FitReport report = FitOf(ModuleCurve(Model::kSingleDiode, truth, 1e-3));
  EXPECT_EQ(report.refined[2], 1);
  EXPECT_THAT(report.no_intervals_because, HasSubstr("n1 = 1, its lower bound"));
}

// The n of a stated thin film may be above 2, and the report says what is in it.
TEST(RefutedBound, ThinFilmsHaveRoomAboveIt) {
  IvCurve curve = ModuleCurve(Model::kSingleDiode, kSteepTruth, 1e-3);
  curve.notes.technology = "perovskite";
  const FitReport report = FitOf(curve);
  EXPECT_EQ(report.no_intervals_because, "");
  EXPECT_NEAR(report.refined[2], 2.7, 0.1);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("is above 2: collection, ions, a barrier")));
  IvCurve beyond = ModuleCurve(Model::kSingleDiode, {3.8, 0.22, 8, 0.05, 300}, 1e-4);
  beyond.notes.technology = "organic";
  EXPECT_THAT(FitOf(beyond).no_intervals_because, HasSubstr("n1 = 6, its upper bound"));
}

TEST(RefutedBound, ASecondDiodeAtTwoKeepsItsIntervals) {
  const auto rtc = ReadCurve(std::string(LYREFIT_DATA_DIR) + "/rtc_france");
  ASSERT_TRUE(rtc);
  FitOptions options;
  options.model = Model::kDoubleDiode;
  const FitReport report = FitOf(*rtc, options);
  EXPECT_EQ(report.no_intervals_because, "");
  EXPECT_GT(report.estimates[kRs].high_95, report.estimates[kRs].low_95);
}

// If the true value is at the bound, one fit in twenty refutes it by chance.
TEST(RefutedBound, TruthsAtTheBoundAreSeldomRefuted) {
  constexpr int kCurves = 60;
  std::vector<double> truth = kSingleTruth;
  truth[1] = 3e-4;
  truth[2] = 2;
  int at_bound = 0, refuted = 0;
  FitOptions options;
  options.find_errors = options.random_baseline = false;
  for (int seed = 1; seed <= kCurves; ++seed) {
    const FitReport report = FitOf(ModuleCurve(Model::kSingleDiode, truth, 4e-3, seed), options);
    at_bound += report.estimates[2].at_bound == BoundSide::kUpper ? 1 : 0;
    refuted += report.no_intervals_because.empty() ? 0 : 1;
  }
  EXPECT_GT(at_bound, 15);
  EXPECT_LE(refuted, 7);
}

}  // namespace
}  // namespace lyrefit
