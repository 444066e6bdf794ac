#include "lyrefit/estimate/fit/usable.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "error_of.h"
#include "lyrefit/base/random.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/model/kernel.h"
#include "synthetic/curves.h"

namespace lyrefit {
namespace {

using ::testing::AnyOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

FitOptions Quick() {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.random_baseline = false;
  return options;
}

TEST(UsableTest, AStepIsNamedFirstAndMakesAFitUseless) {
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode}) {
    FitOptions options = Quick();
    options.model = model;
    const auto report = Fit(SyntheticModule(1, 1, 0.5), options);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->usable);
    // Two substrings of 12.1 V at that current, minus the voltage of the conducting bypass diode.
    EXPECT_THAT(report->not_usable_because, HasSubstr("a step near 23."));
    EXPECT_THAT(report->not_usable_because, HasSubstr("% of Isc"));
    EXPECT_EQ(report->warnings.at(0), "the fit is not usable: " + report->not_usable_because);
  }
}

TEST(UsableTest, SoundCurvesAreFittedWithoutSuchWarnings) {
  for (const IvCurve& curve : {SyntheticModule(), SyntheticCell(), SyntheticCell(0)}) {
    const auto report = Fit(curve, Quick());
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->usable) << report->not_usable_because;
    EXPECT_EQ(report->not_usable_because, "");
    EXPECT_THAT(report->doubts, IsEmpty());
  }
}

TEST(UsableTest, WhatIsNoCurveIsNotUsable) {
  IvCurve curve = SyntheticModule();
  RandomStream random(5);
  for (std::size_t k = curve.size() - 1; k > 0; --k) {
    std::swap(
        curve.current_A[k],
        curve.current_A[static_cast<std::size_t>(random.Uniform() * static_cast<double>(k + 1))]);
  }
  const auto shuffled = Fit(curve, Quick());
  ASSERT_TRUE(shuffled);
  EXPECT_FALSE(shuffled->usable);
  EXPECT_THAT(shuffled->warnings.at(0), StartsWith("the fit is not usable: "));
  for (double& current : curve.current_A) current = 9 * random.Uniform();
  const auto noise = Fit(curve, Quick());
  EXPECT_TRUE(!noise || !noise->usable);
}

TEST(UsableTest, ALineIsNoCurveWhetherItFallsOrRises) {
  const auto line = [](double slope_A_V, double noise_A, int seed) {
    IvCurve curve;
    curve.conditions.cells_in_series = 60;
    RandomStream random(seed, 0);
    for (int k = 0; k < 40; ++k) {
      const double voltage_V = k < 39 || slope_A_V > 0 ? 36.0 * k / 39 : 36.5;
      curve.voltage_V.push_back(voltage_V);
      curve.current_A.push_back(8 + slope_A_V * voltage_V + noise_A * random.Normal());
    }
    return curve;
  };
  for (const double slope_A_V : {-8.0 / 36, -0.4 / 36, 1.0 / 36}) {
    for (const double noise_A : {0.0, 1e-3, 0.05}) {
      for (int seed = 1; seed <= 3; ++seed) {
        IvCurve curve = line(slope_A_V, noise_A, seed);
        curve.as_is = true;  // otherwise a rising current is refused
        const auto report = Fit(curve, Quick());
        ASSERT_TRUE(report) << report.error().ToString();
        EXPECT_FALSE(report->usable) << slope_A_V << ' ' << noise_A;
        EXPECT_EQ(report->not_usable_because, "a straight line describes these points as well");
      }
    }
  }
}

TEST(UsableTest, ARowLoggedAtNightSaysSo) {
  IvCurve curve;
  curve.conditions.cells_in_series = 60;
  curve.conditions.irradiance_W_m2 = 0;
  RandomStream random(2, 0);
  for (int k = 0; k < 40; ++k) {
    curve.voltage_V.push_back(0.02 * k);
    curve.current_A.push_back(2e-3 * random.Normal());
  }
  const auto report = Fit(curve, Quick());
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_THAT(report->not_usable_because, StartsWith("night: 0 W/m2 are stated"));
  EXPECT_THAT(report->doubts, IsEmpty());
}

// AICc calls five parameters too many for eight readings, however well they describe them.
TEST(UsableTest, EightReadingsOfADiodeAreNoLine) {
  IvCurve curve;
  curve.conditions.cells_in_series = 8;
  curve.voltage_V = {0, 1, 2, 3, 3.5, 4, 4.3, 4.6};
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> truth = {0.3, 2e-8, 1.35, 1, 150};
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  RandomStream random(2);
  for (double& current : curve.current_A) current += 2e-3 * random.Normal();
  const auto report = Fit(curve, Quick());
  ASSERT_TRUE(report);
  EXPECT_EQ(report->not_usable_because, "");
}

TEST(UsableTest, ADarkCurveHasNoKeyPoints) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1;
  for (int k = 0; k <= 60; ++k) curve.voltage_V.push_back(-0.2 + 0.05 * k);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> truth = {0, 1e-18, 1.9, 5, 1e6};
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  RandomStream random(4);
  for (double& current : curve.current_A) current += 1e-5 * random.Normal() - 1e-6;
  const auto report = Fit(curve, Quick());
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->usable);
  EXPECT_NEAR(report->refined[2], 1.9, 0.1);
  for (const KeyPoints& key : {report->measured, report->simulated}) {
    EXPECT_TRUE(std::isnan(key.open_circuit_voltage_V) && std::isnan(key.max_power_W));
  }
  for (const std::string& warning : report->warnings) {
    EXPECT_EQ(warning.find("does not reach"), std::string::npos) << warning;
  }
}

TEST(UsableTest, NoLightIsBlamedForADarkCurve) {
  IvCurve curve;
  curve.conditions.cells_in_series = 1;
  curve.cells_known = true;
  for (int k = 0; k <= 90; ++k) curve.voltage_V.push_back(-0.2 + 0.04 * k);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> truth = {0, 1e-18, 2.7, 9, 1e7};
  curve.current_A = SolveCurrents(device, truth.data(), curve.voltage_V);
  for (std::size_t k = 0; k < curve.size(); ++k) {  // a shape that no diode has
    curve.current_A[k] *= 1 + 3e-3 * std::sin(0.3 * static_cast<double>(k));
  }
  const auto report = Fit(curve, Quick());
  ASSERT_TRUE(report);
  EXPECT_EQ(report->refine.termination, "converged");
  EXPECT_THAT(report->warnings, Contains(HasSubstr("tunnelling, a barrier or another junction")));
  EXPECT_THAT(report->warnings, Contains(HasSubstr("or the device warmed")));
  EXPECT_THAT(report->warnings, Not(Contains(AnyOf(HasSubstr("light"), HasSubstr("collection")))));
}

TEST(UsableTest, NoIntervalsAreFoundAroundAFitThatIsNot) {
  for (const Intervals method : {Intervals::kProfile, Intervals::kSymmetric, Intervals::kNone}) {
    FitOptions options = Quick();
    options.intervals = method;
    options.model = Model::kDoubleDiode;
    bool sought = false;
    const auto report = Fit(SyntheticModule(1, 1, 0.5), options, [&](const Progress& progress) {
      sought = sought || progress.stage == "intervals";
      return ObserverAction::kContinue;
    });
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->usable);
    EXPECT_FALSE(sought);
    const bool asked = method != Intervals::kNone;
    EXPECT_THAT(report->no_intervals_because, StartsWith(asked ? "the fit is not usable" : ""));
    EXPECT_EQ(report->no_intervals_because.empty(), !asked);
    for (const Estimate& e : report->estimates) {
      EXPECT_EQ(e.interval, IntervalMethod::kNone);
      EXPECT_TRUE(std::isnan(e.low_95) && std::isnan(e.standard_error));
      EXPECT_TRUE(std::isfinite(e.refined));
    }
  }
  FitOptions options = Quick();
  options.intervals = Intervals::kSymmetric;
  EXPECT_EQ(Fit(SyntheticModule(), options)->no_intervals_because, "");
}

TEST(UsableTest, WhatASearchAloneMissesIsNotTheModelsFault) {
  FitOptions options = Quick();
  options.polish = false;
  options.search.iterations = 2;
  const auto report = Fit(SyntheticModule(), options);
  ASSERT_TRUE(report);
  EXPECT_THAT(report->not_usable_because, AnyOf("", HasSubstr("straight line")));
}

TEST(UsableTest, ALimitOfTheInstrumentIsDoubtedBeforeAllElse) {
  IvCurve curve = SyntheticCell();
  for (double& current : curve.current_A) current = std::max(current, -0.05);
  FitOptions options = Quick();
  options.loss = Loss::kHuber;
  const auto report = Fit(curve, options);
  ASSERT_TRUE(report);
  ASSERT_EQ(report->doubts.size(), 1U);
  EXPECT_THAT(report->doubts[0], HasSubstr("exactly the same current -0.05 A"));
  EXPECT_THAT(report->warnings, ::testing::Contains(report->doubts[0]));
}

TEST(UsableTest, ImplausibleReadingsAreRefusedAsTheyAreOnlyIfAsked) {
  IvCurve curve = SyntheticModule();
  curve.conditions.cells_in_series = 600;
  EXPECT_THAT(MessageOf(Fit(curve, Quick())), HasSubstr("give --cells 60?"));
  curve.as_is = true;
  const auto taken = Fit(curve, Quick());
  ASSERT_TRUE(taken);
  EXPECT_THAT(taken->doubts, ::testing::ElementsAre(HasSubstr("give --cells 60?")));
}

}  // namespace
}  // namespace lyrefit
