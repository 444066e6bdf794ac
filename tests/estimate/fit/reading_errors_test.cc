#include "lyrefit/estimate/fit/reading_errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "error_of.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/settings/error_file.h"
#include "repeats.h"
#include "synthetic/curves.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FitReport FitWith(const IvCurve& curve, const ErrorSpec& errors) {
  FitOptions options;
  options.errors = errors;
  auto report = Fit(curve, options);
  EXPECT_TRUE(report) << report.error().ToString();
  return report ? std::move(*report) : FitReport();
}

const ErrorSpec kField = {ErrorKind::kField, {}, "field"};

TEST(ReadingErrors, IntervalsUnderThemHoldTheTruthWherePlainOnesDoNot) {
  SKIP_IF_SANITIZED();
  constexpr int kCurves = 100;
  int plain = 0, under = 0, weighed = 0;
  for (int seed = 0; seed < kCurves; ++seed) {
    const IvCurve curve = WanderingCurve(seed);
    const FitReport white = FitWith(curve, {}), field = FitWith(curve, kField);
    ASSERT_TRUE(white.errors.has_value());
    ASSERT_TRUE(field.errors.has_value());
    EXPECT_TRUE(white.errors->believed);
    ASSERT_EQ(white.under_errors.size(), 5U);
    EXPECT_TRUE(field.under_errors.empty());
    for (int i = 0; i < 5; ++i) {
      const auto holds = [&](const Estimate& e) {
        return e.low_95 <= kSingleTruth[i] && kSingleTruth[i] <= e.high_95 ? 1 : 0;
      };
      plain += holds(white.estimates[i]);
      under += holds(white.under_errors[i]);
      weighed += holds(field.estimates[i]);
    }
  }
  EXPECT_LT(plain, 0.7 * 5 * kCurves);
  EXPECT_GT(under, 0.9 * 5 * kCurves);
  EXPECT_GT(weighed, 0.9 * 5 * kCurves);
}

TEST(ReadingErrors, WhiteOnesLeaveThePlainFitAlone) {
  int asked = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    const IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 4e-3, seed, 100);
    const FitReport report = FitWith(curve, {});
    ASSERT_TRUE(report.errors.has_value());
    asked += report.errors->believed ? 1 : 0;
    EXPECT_EQ(report.under_errors.empty(), !report.errors->believed);
    EXPECT_LT(report.errors->sizes.path, 3e-3);
    EXPECT_FALSE(report.errors->weighed);
  }
  EXPECT_LE(asked, 4);
}

// Errors of the voltages are independent: larger near Voc, but not shared by neighbours.
TEST(ReadingErrors, NoiseOfVoltagesIsNotTakenForAPath) {
  const IvCurve exact = ModuleCurve(Model::kSingleDiode, kSingleTruth, 0);
  int unequal = 0, path = 0, holds = 0;
  constexpr int kCurves = 40;
  for (int seed = 1; seed <= kCurves; ++seed) {
    IvCurve curve = exact;
    RandomStream random(seed, 7);
    for (double& voltage_V : curve.voltage_V) voltage_V *= 1 + 4e-4 * random.Normal();
    for (double& current_A : curve.current_A) current_A += 4e-4 * random.Normal();
    const FitReport report = FitWith(curve, {});
    ASSERT_TRUE(report.errors.has_value());
    unequal += report.errors->Taken() == ErrorsTaken::kUnequal ? 1 : 0;
    path += report.errors->Taken() == ErrorsTaken::kPath ? 1 : 0;
    if (report.under_errors.size() != 5U) continue;
    const Estimate& rs = report.under_errors[3];
    holds += rs.low_95 <= kSingleTruth[3] && kSingleTruth[3] <= rs.high_95 ? 1 : 0;
  }
  EXPECT_GE(unequal, 0.9 * kCurves);
  EXPECT_LE(path, 0.1 * kCurves);
  EXPECT_GE(holds, 0.85 * kCurves);
}

TEST(ReadingErrors, AreNotLookedForWhereNobodyAsks) {
  const IvCurve curve = WanderingCurve(1);
  FitOptions options;
  options.find_errors = false;
  const auto without = Fit(curve, options);
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->errors.has_value());
  EXPECT_TRUE(without->under_errors.empty());
  const FitReport with = FitWith(curve, {});
  EXPECT_TRUE(with.errors.has_value());
  EXPECT_EQ(without->refined, with.refined);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(without->estimates[i].low_95, with.estimates[i].low_95);
    EXPECT_EQ(without->estimates[i].high_95, with.estimates[i].high_95);
  }
}

TEST(ReadingErrors, AFitWeighedByThemIsNotTheLowestButNearerToTheTruth) {
  SKIP_IF_SANITIZED();
  double plain = 0, weighed = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const IvCurve curve = WanderingCurve(seed);
    const FitReport white = FitWith(curve, {}), field = FitWith(curve, kField);
    EXPECT_GT(field.rmse.refined.solved_current_A, white.rmse.refined.solved_current_A);
    EXPECT_DOUBLE_EQ(field.errors->least_squares.solved_current_A,
                     white.rmse.refined.solved_current_A);
    plain += std::pow(white.refined[2] - kSingleTruth[2], 2);
    weighed += std::pow(field.refined[2] - kSingleTruth[2], 2);
  }
  EXPECT_LT(weighed, 0.85 * plain);
}

TEST(ReadingErrors, StatedSizesAreBelieved) {
  const ErrorSpec stated = {ErrorKind::kStated, {5e-4, 6e-3, 2e-3}, "mine.json"};
  const FitReport report = FitWith(WanderingCurve(1), stated);
  ASSERT_TRUE(report.errors.has_value());
  EXPECT_TRUE(report.errors->stated);
  EXPECT_EQ(report.errors->sizes.path, 2e-3);
  const ErrorSpec twice = {ErrorKind::kStated, {1e-3, 12e-3, 4e-3}, "mine.json"};
  const FitReport wider = FitWith(WanderingCurve(1), twice);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(wider.refined[i] / report.refined[i], 1, 0.02) << i;
    EXPECT_NEAR(wider.estimates[i].standard_error / report.estimates[i].standard_error, 2, 0.1)
        << i;
  }
}

TEST(ReadingErrors, WeighTheBenchmarkCurves) {
  for (const char* name : {"rtc_france", "pwp201", "stm6_40_36"}) {
    const auto curve = ReadCurve(std::string(LYREFIT_DATA_DIR) + "/" + name);
    ASSERT_TRUE(curve) << curve.error().ToString();
    const FitReport report = FitWith(*curve, kField);
    EXPECT_TRUE(report.usable);
    ASSERT_TRUE(report.errors.has_value()) << name;
    EXPECT_TRUE(report.errors->weighed);
    EXPECT_GE(report.rmse.refined.solved_current_A, report.errors->least_squares.solved_current_A);
    for (const Estimate& e : report.estimates) {
      EXPECT_LE(e.low_95, e.refined) << name << ' ' << e.info.symbol;
      EXPECT_GE(e.high_95, e.refined) << name << ' ' << e.info.symbol;
    }
  }
}

TEST(ReadingErrors, NeedTheSolvedCurrentAndSquares) {
  FitOptions options;
  options.errors = kField;
  options.objective = Objective::kMeasuredCurrent;
  EXPECT_THAT(MessageOf(Fit(WanderingCurve(1), options)), HasSubstr("measured-current"));
  options.objective = Objective::kSolvedCurrent;
  options.loss = Loss::kHuber;
  EXPECT_FALSE(Fit(WanderingCurve(1), options));
}

TEST(ReadingErrors, OfTheMeasuredCurrentStandBesideItsPlainIntervals) {
  FitOptions options;
  options.objective = Objective::kMeasuredCurrent;
  const auto report = Fit(WanderingCurve(2), options);
  ASSERT_TRUE(report);
  ASSERT_TRUE(report->errors.has_value());
  const FitReport solved = FitWith(WanderingCurve(2), {});
  EXPECT_NEAR(report->errors->sizes.path / solved.errors->sizes.path, 1, 0.1);
}

TEST(ReadingErrors, AreReadFromAFile) {
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    return ErrorsNamed(folder.Write("errors.json", text));
  };
  const auto good =
      read(R"({"current_noise_A": 0.001, "voltage_noise_V": 0, "path_of_isc": 0.0012})");
  ASSERT_TRUE(good) << good.error().ToString();
  EXPECT_EQ(good->kind, ErrorKind::kStated);
  EXPECT_EQ(good->sizes.path, 0.0012);
  const auto refused = [&](const std::string& text, const std::string& sentence) {
    const auto found = read(text);
    ASSERT_FALSE(found) << text;
    EXPECT_THAT(found.error().ToString(), HasSubstr(sentence));
  };
  refused("{\n\"current_noise_A\": -1, \"voltage_noise_V\": 0, \"path_of_isc\": 0}",
          "errors.json:2:1: expected a number from 0 up");
  refused(R"({"current_noise_A": 1, "voltage_noise_V": 0})", "expected \"path_of_isc\"");
  refused(R"({"current_noise_A": 0, "voltage_noise_V": 0, "path_of_isc": 0})", "above 0");
  refused(R"({"current_noise_A": 1, "voltage_noise_V": 0, "path_of_isc": 0, "more": 1})", "more");
  refused("[1]", "errors.json:1:1: expected sizes of errors");
  EXPECT_FALSE(ErrorsNamed(folder.Path("none.json")));
}

}  // namespace
}  // namespace lyrefit
