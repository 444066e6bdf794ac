#include "lyrefit/translate/field_test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../error_of.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Pmax with a normal uncertainty, with or without Monte Carlo draws.
UncertainOutput Power(double value_W, double u_W, int draws = 0) {
  UncertainModel model;
  model.outputs = {{"max_power", "Pmax", "W"}};
  model.evaluate = [](const std::vector<double>& x) { return x; };
  UncertainInput input;
  input.name = "Pmax";
  input.value = value_W;
  input.standard_uncertainty = u_W;
  UncertaintyOptions options;
  options.draws = draws;
  return Propagate(model, {{input}}, options)->outputs[0];
}

FieldMeasurement Measured(double power_W, double irradiance_W_m2 = 800, double temperature_C = 45) {
  FieldMeasurement measurement;
  measurement.measured.max_power_voltage_V = 30;
  measurement.measured.max_power_current_A = power_W / 30;
  measurement.measured.max_power_W = power_W;
  measurement.inputs.irradiance_W_m2 = irradiance_W_m2;
  measurement.inputs.temperature_C = temperature_C;
  measurement.inputs.voltage_gain = measurement.inputs.current_gain = 1;
  return measurement;
}

FieldTestOptions Rated(double rated_W, const char* tolerance) {
  FieldTestOptions options;
  options.rated_W = rated_W;
  options.tolerance = *ReadTolerance(tolerance);
  options.power_coefficient_percent_K = -0.4;
  return options;
}

FieldTest Judged(const UncertainOutput& power, const FieldTestOptions& options,
                 UncertaintyOptions uncertainty = {}) {
  uncertainty.draws = 0;
  const auto test = JudgeFieldTest(power, Measured(300), options, uncertainty);
  EXPECT_TRUE(test) << test.error().ToString();
  return test.value_or(FieldTest{});
}

TEST(FieldTest, HasFiveZones) {
  const FieldTestOptions options = Rated(400, "-0,+5");
  EXPECT_EQ(Judged(Power(410, 4), options).zone, Zone::kPass);
  EXPECT_EQ(Judged(Power(408, 4), options).zone, Zone::kPass) << "400 is enough";
  EXPECT_EQ(Judged(Power(407.9, 4), options).zone, Zone::kPassWithin);
  EXPECT_EQ(Judged(Power(403.4, 4), options).zone, Zone::kPassWithin) << "80.2 %";
  EXPECT_EQ(Judged(Power(403.3, 4), options).zone, Zone::kUndecided) << "79.5 %";
  EXPECT_EQ(Judged(Power(400, 4), options).zone, Zone::kUndecided);
  EXPECT_EQ(Judged(Power(396.7, 4), options).zone, Zone::kUndecided);
  EXPECT_EQ(Judged(Power(396.6, 4), options).zone, Zone::kFailWithin);
  EXPECT_EQ(Judged(Power(392, 4), options).zone, Zone::kFailWithin);
  EXPECT_EQ(Judged(Power(391.9, 4), options).zone, Zone::kFail);
}

TEST(FieldTest, LimitIsTheRatingLessItsTolerance) {
  EXPECT_DOUBLE_EQ(Judged(Power(400, 4), Rated(400, "-3,+3")).lowest_W, 388);
  EXPECT_DOUBLE_EQ(Judged(Power(400, 4), Rated(400, "-0W,+5W")).highest_W, 405);
  FieldTestOptions string = Rated(400, "-5W,+5W");
  string.modules = 20;
  string.strings = 2;
  string.cabling_percent = 1;
  const FieldTest test = Judged(Power(15700, 100), string);
  EXPECT_DOUBLE_EQ(test.rated_W, 40 * 400 * 0.99);
  EXPECT_DOUBLE_EQ(test.lowest_W, 40 * 395 * 0.99);
}

TEST(FieldTest, ProbabilityOfAWrongVerdictIsThatOfTheOtherSide) {
  const FieldTestOptions options = Rated(400, "-0,+5");
  EXPECT_NEAR(Judged(Power(404, 4), options).probability_wrong, 0.158655, 1e-6);
  EXPECT_NEAR(Judged(Power(396, 4), options).probability_wrong, 0.158655, 1e-6);
  EXPECT_NEAR(Judged(Power(400, 4), options).probability_wrong, 0.5, 1e-12);
  const FieldTest drawn = Judged(Power(404, 4, 100000), options);
  EXPECT_NEAR(drawn.probability_wrong, 0.158655, 0.005);
  EXPECT_DOUBLE_EQ(drawn.probability_step, 1e-5);
  EXPECT_NEAR(Judged(Power(396, 4), options).probability_conforms, 0.158655, 1e-6);
  const FieldTest sure = Judged(Power(450, 4, 10000), options);
  EXPECT_EQ(sure.probability_wrong, 0);
  EXPECT_THAT(sure.sentence, HasSubstr("more than 99.99 %")) << "10,000 draws show no more";
  EXPECT_THAT(Judged(Power(350, 4, 10000), options).sentence, HasSubstr("less than 0.01 %"));
}

TEST(FieldTest, AnUncertainRatingMakesTheVerdictLessSure) {
  FieldTestOptions options = Rated(400, "-0,+5");
  const FieldTest promised = Judged(Power(408, 4), options);
  options.rated_percent = 1.5;  // 3 W
  const FieldTest test = Judged(Power(408, 4), options);
  EXPECT_EQ(promised.zone, Zone::kPass);
  EXPECT_EQ(test.zone, Zone::kPassWithin);
  EXPECT_NEAR(test.probability_wrong, 0.5 * std::erfc(8.0 / 5 / std::sqrt(2.0)), 1e-9);
  EXPECT_DOUBLE_EQ(test.standard_low_W, 400) << "the measurement is as sure as it was";
  const FieldTest drawn = Judged(Power(408, 4, 100000), options);
  EXPECT_NEAR(drawn.probability_wrong, test.probability_wrong, 0.003);
}

TEST(FieldTest, PerformanceFactorIsMeasuredOverPredicted) {
  FieldTestOptions options = Rated(400, "-0,+5");
  options.cabling_percent = 2;
  const FieldTest test = Judged(Power(400, 4), options);
  const double predicted = 400 * 0.8 * (1 - 0.004 * 20) * (1 - 0.02 * 0.8);
  EXPECT_DOUBLE_EQ(test.predicted_W, predicted);
  EXPECT_DOUBLE_EQ(test.performance_factor, 300 / predicted);
  EXPECT_LT(test.performance_low, test.performance_factor);
  // Contributions: light 5 % (slightly less because of cabling), voltage and current 1 % each, 1 K
  // and 2 K at -0.4 % / 0.92, gamma 5 % of 8 %.
  const double light = 0.05 * (1 - 0.016 / 0.984);
  const double kelvin = 0.004 / 0.92;
  const double expanded = std::sqrt(light * light + 2 * 0.01 * 0.01 + kelvin * kelvin * (1 + 4) +
                                    std::pow(0.05 * 0.08 / 0.92, 2));
  EXPECT_NEAR((test.performance_high - test.performance_low) / 2 / test.performance_factor,
              expanded, 0.002 * expanded + 5e-5);
}

// Power far above the rating gives no verdict; wrong units, another device or other light can cause
// it.
TEST(FieldTest, JudgesNoPowerFarAboveTheRating) {
  UncertaintyOptions uncertainty;
  uncertainty.draws = 0;
  const auto high =
      JudgeFieldTest(Power(281285, 8000), Measured(225000), Rated(300, "-0,+5"), uncertainty);
  ASSERT_TRUE(high);
  EXPECT_EQ(high->zone, Zone::kDoubtful);
  EXPECT_FALSE(IsPass(high->zone));
  EXPECT_TRUE(std::isnan(high->probability_wrong));
  EXPECT_THAT(high->doubt, HasSubstr("performance factor of"));
  EXPECT_THAT(high->sentence, HasSubstr("cannot be held against the rating"));
  EXPECT_THAT(high->notes, IsEmpty());
  const auto carried =
      JudgeFieldTest(Power(700, 8), Measured(300), Rated(400, "-0,+5"), uncertainty);
  ASSERT_TRUE(carried);
  EXPECT_EQ(carried->zone, Zone::kDoubtful);
  EXPECT_THAT(carried->doubt, HasSubstr("1.75 times the rating"));
  const auto bifacial =
      JudgeFieldTest(Power(520, 8), Measured(380), Rated(400, "-0,+5"), uncertainty);
  ASSERT_TRUE(bifacial);
  EXPECT_EQ(bifacial->zone, Zone::kPass);
}

// The power of one module held against the rating of a string, or another unit.
TEST(FieldTest, JudgesNoPowerFarBelowTheRating) {
  UncertaintyOptions uncertainty;
  uncertainty.draws = 0;
  const auto zone = [&](double power_W, double measured_W, int modules) {
    FieldTestOptions options = Rated(400, "-0,+5");
    options.modules = modules;
    const auto test = JudgeFieldTest(Power(power_W, 4), Measured(measured_W), options, uncertainty);
    EXPECT_TRUE(test);
    return test ? test->zone : Zone::kPass;
  };
  EXPECT_EQ(zone(0.4, 0.3, 1), Zone::kDoubtful);
  EXPECT_EQ(zone(400, 300, 20), Zone::kDoubtful);
  EXPECT_EQ(zone(400, 300, 5), Zone::kDoubtful) << "one of five";
  EXPECT_EQ(zone(1200, 900, 5), Zone::kFail) << "three of five may be left";
  EXPECT_EQ(zone(400, 300, 2), Zone::kFail) << "one of two may be left";
}

TEST(FieldTest, JudgesNoReadingsThatNoDeviceHas) {
  UncertaintyOptions uncertainty;
  uncertainty.draws = 0;
  FieldMeasurement measurement = Measured(300);
  measurement.doubt = "Isc is more than any cell gives";
  const auto test = JudgeFieldTest(Power(400, 4), measurement, Rated(400, "-0,+5"), uncertainty);
  ASSERT_TRUE(test);
  EXPECT_EQ(test->zone, Zone::kDoubtful);
  EXPECT_EQ(test->doubt, measurement.doubt);
  EXPECT_THAT(test->sentence, HasSubstr("more than any cell gives"));
}

TEST(FieldTest, PredictionOfAModelStandsInForTheRating) {
  const FieldTestOptions options = Rated(400, "-0,+5");
  FieldMeasurement measurement = Measured(300);
  measurement.predicted_W = 305;
  measurement.predicted_by = "De Soto's law of healthy strings";
  UncertaintyOptions uncertainty;
  uncertainty.draws = 0;
  const auto test = JudgeFieldTest(Power(400, 4), measurement, options, uncertainty);
  ASSERT_TRUE(test);
  EXPECT_DOUBLE_EQ(test->performance_factor, 300.0 / 305);
  EXPECT_EQ(test->predicted_by, "De Soto's law of healthy strings");
}

TEST(FieldTest, SaysWhatCannotBeSeen) {
  UncertaintyOptions by_curve;
  by_curve.light_source = LightSource::kCurve;
  EXPECT_THAT(Judged(Power(400, 4), Rated(400, "-0,+5"), by_curve).notes,
              testing::Contains(HasSubstr("uniform soiling")));
  EXPECT_THAT(Judged(Power(400, 4), Rated(400, "-0,+5")).notes, IsEmpty());
  EXPECT_THAT(Judged(Power(440, 4), Rated(400, "-0,+5")).notes,
              testing::Contains(HasSubstr("the light was brighter")));
  FieldTestOptions bare = Rated(400, "-0,+5");
  bare.power_coefficient_percent_K.reset();
  EXPECT_THAT(Judged(Power(400, 4), bare).notes, testing::Contains(HasSubstr("--gamma")));
}

TEST(FieldTest, RefusesWhatCannotBeTested) {
  FieldTestOptions options;
  const FieldMeasurement measurement = Measured(300);
  EXPECT_THAT(MessageOf(JudgeFieldTest(Power(400, 4), measurement, options, {})),
              HasSubstr("--rated-W"));
  options.rated_W = -1;
  EXPECT_THAT(MessageOf(JudgeFieldTest(Power(400, 4), measurement, options, {})),
              HasSubstr("rated-W = -1 is outside [1e-06, 1000000]"));
  options.rated_W = 400;
  EXPECT_THAT(MessageOf(JudgeFieldTest(UncertainOutput{}, measurement, options, {})),
              HasSubstr("nothing to test"));
}

}  // namespace
}  // namespace lyrefit
