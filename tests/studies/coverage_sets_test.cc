#include "studies/coverage_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "lyrefit/base/constants.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

struct Case {
  TranslationLaw law;
  Model model;
};

CoverageOptions OptionsOf(const Case& c) {
  CoverageOptions options;
  options.family.law = c.law;
  options.family.model = c.model;
  return options;
}

constexpr Case kCases[] = {{TranslationLaw::kDeSoto, Model::kSingleDiode},
                           {TranslationLaw::kDeSoto, Model::kDoubleDiode},
                           {TranslationLaw::kPvsyst, Model::kSingleDiode},
                           {TranslationLaw::kPvsyst, Model::kDoubleDiode}};

TEST(SimulateSet, DrawsModulesWithinTheStatedRanges) {
  for (const Case& c : kCases) {
    for (int s = 0; s < 50; ++s) {
      const auto made = SimulateSet(OptionsOf(c), s);
      ASSERT_TRUE(made) << made.error().ToString();
      const Translation& t = made->translation;
      const TranslatedDevice module =
          TranslateTo(t, made->truth, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
      const KeyPoints points = ModelKeyPoints(module.device, module.parameters.data());
      const double voc = points.open_circuit_voltage_V / t.spec.cells_in_series;
      EXPECT_GT(points.short_circuit_current_A, 2.98) << s;
      EXPECT_LT(points.short_circuit_current_A, 10.02) << s;
      EXPECT_GT(voc, 0.5499) << s;
      EXPECT_LT(voc, 0.7001) << s;
      EXPECT_GE(made->truth[t.n], 1);
      EXPECT_LE(made->truth[t.n], 1.4);
      EXPECT_GE(made->set.curves.size(), 5U);
      EXPECT_LE(made->set.curves.size(), 30U);
    }
  }
}

TEST(SimulateSet, CurvesAreTheTranslatedModelPlusNoiseOfTheStatedSize) {
  CoverageOptions options = OptionsOf(kCases[3]);
  options.curves = 22;
  options.points = 100;
  const auto made = SimulateSet(options, 4);
  ASSERT_TRUE(made);
  const TranslatedDevice reference = TranslateTo(
      made->translation, made->truth, kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  const double isc =
      ModelKeyPoints(reference.device, reference.parameters.data()).short_circuit_current_A;
  double square = 0;
  int count = 0;
  for (const IvCurve& curve : made->set.curves) {
    const TranslatedDevice module =
        TranslateTo(made->translation, made->truth, curve.conditions.irradiance_W_m2,
                    curve.conditions.cell_temperature_K);
    const auto exact = SolveCurrents(module.device, module.parameters.data(), curve.voltage_V);
    for (std::size_t i = 0; i < exact.size(); ++i, ++count) {
      square += std::pow((curve.current_A[i] - exact[i]) / isc, 2);
    }
    EXPECT_NEAR(exact.back(), 0, 1e-6) << "the last point is open circuit";
  }
  // With 2200 draws the standard deviation has a standard error of 1.5 %; the tolerance is five
  // times that.
  EXPECT_NEAR(std::sqrt(square / count), options.noise_relative, 0.075 * options.noise_relative);
}

TEST(SimulateSet, TakesEveryConditionOfTheGridOnceBeforeAnyTwice) {
  CoverageOptions options;
  options.curves = 22;
  const auto made = SimulateSet(options, 1);
  ASSERT_TRUE(made);
  std::set<std::tuple<double, double>> seen;
  for (const IvCurve& curve : made->set.curves) {
    seen.emplace(curve.conditions.irradiance_W_m2, curve.conditions.cell_temperature_K);
  }
  EXPECT_EQ(seen.size(), 22U);
  options.curves = 5;
  const auto small = SimulateSet(options, 1);
  EXPECT_EQ(small->set.curves[1].conditions.cell_temperature_K, 75 + kZeroCelsius_K);
}

TEST(SimulateSet, SensorsReadWrongWhileTheCurvesAreRight) {
  CoverageOptions options;
  const auto right = SimulateSet(options, 2);
  options.temperature_error_K = 2;
  options.irradiance_error_W_m2 = -10;
  const auto wrong = SimulateSet(options, 2);
  ASSERT_TRUE(right && wrong);
  for (std::size_t i = 0; i < right->set.curves.size(); ++i) {
    const IvCurve &a = right->set.curves[i], &b = wrong->set.curves[i];
    EXPECT_EQ(a.current_A, b.current_A);
    EXPECT_NEAR(b.conditions.cell_temperature_K - a.conditions.cell_temperature_K, 2, 1e-9);
    EXPECT_NEAR(b.conditions.irradiance_W_m2 - a.conditions.irradiance_W_m2, -10, 1e-9);
  }
}

TEST(SimulateSet, EverySetHasItsOwnDraws) {
  const CoverageOptions options;
  const auto first = SimulateSet(options, 0), again = SimulateSet(options, 0),
             second = SimulateSet(options, 1);
  EXPECT_EQ(first->truth, again->truth);
  EXPECT_EQ(first->set.curves[0].current_A, again->set.curves[0].current_A);
  EXPECT_NE(first->truth, second->truth);
}

TEST(SimulateSet, KeepsToTheModuleThatIsStated) {
  CoverageOptions options;
  options.cells_in_series = 36;
  options.module = {{"Iph", 4.715},       {"I_o_ref", 6.35e-10}, {"n", 1.03},   {"Rs", 0.282},
                    {"R_sh_ref", 85.824}, {"alpha", 0.002},      {"Eg", 1.0386}};
  const auto made = SimulateSet(options, 0);
  ASSERT_TRUE(made) << made.error().ToString();
  EXPECT_EQ(made->truth,
            (std::vector<double>{4.715, 6.35e-10, 1.03, 0.282, 85.824, 0.002, 1.0386, -0.0002677}));
  EXPECT_EQ(made->set.curves[0].conditions.cells_in_series, 36);
  EXPECT_NEAR(made->set.curves[0].voltage_V.back(), 21.6, 0.01);
}

}  // namespace
}  // namespace lyrefit
