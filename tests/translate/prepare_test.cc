#include "lyrefit/translate/prepare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "synthetic_string.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TranslateOptions NoDiagnosis(const SyntheticModule& module) {
  TranslateOptions options;
  options.coefficients = module.Coefficients();
  options.procedures = {Procedure::kDeSoto};
  return options;
}

std::string ErrorOfCurve(const IvCurve& curve, const TranslateOptions& options) {
  const auto made = Prepare(curve, options, {});
  return made ? "" : made.error().message;
}

TEST(Prepare, FindsTheDiodeAndAnchorsItsLawToBeta) {
  const SyntheticModule module;
  const auto made = Prepare(module.Measured(800, 45), NoDiagnosis(module), {});
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_TRUE(made->curve.diode && made->curve.bandgap && made->curve.mu_gamma);
  const SingleDiodeFit truth = module.Diode(800, 45);
  EXPECT_NEAR(made->curve.diode->photocurrent_A, truth.photocurrent_A, 1e-4 * truth.photocurrent_A);
  EXPECT_NEAR(made->curve.diode->nNsVth_V, truth.nNsVth_V, 1e-3 * truth.nNsVth_V);
  EXPECT_NEAR(made->curve.bandgap->value, 1.121, 0.01);
  EXPECT_FALSE(made->diagnosis);
  EXPECT_THAT(made->why_no_model, HasSubstr("not asked for"));
  EXPECT_THAT(made->warnings, IsEmpty());
}

// At 800 W/m2 a sensor on the back of the module reads 2 K less than the cell temperature.
TEST(Prepare, CorrectsASensorOnTheBackToTheCells) {
  const SyntheticModule module;
  TranslateOptions options = NoDiagnosis(module);
  options.further = {module.Measured(600, 40)};
  IvCurve curve = module.Measured(800, 45);
  curve.temperature_C.assign(curve.size(), 45);
  const auto cells = Prepare(curve, options, {});
  options.uncertainty.temperature_source = TemperatureSource::kBackOfModule;
  const auto back = Prepare(curve, options, {});
  ASSERT_TRUE(cells && back);
  EXPECT_DOUBLE_EQ(cells->inputs.values.temperature_C, 45);
  EXPECT_EQ(cells->inputs.cell_correction_K, 0);
  EXPECT_DOUBLE_EQ(back->inputs.values.temperature_C, 47);
  EXPECT_DOUBLE_EQ(back->inputs.cell_correction_K, 2);
  EXPECT_DOUBLE_EQ(back->curve.further[0].temperature_C, 41.5);
  const double colder_n = back->fit->refined[2], n = cells->fit->refined[2];
  EXPECT_NEAR(colder_n / n, (45 + 273.15) / (47 + 273.15), 1e-6) << "the fit is at the cells'";
}

TEST(Prepare, RefusesAndDoubtsReadingsAsAFitDoes) {
  const SyntheticModule module;
  TranslateOptions options = NoDiagnosis(module);
  options.procedures = {Procedure::kIec1};
  IvCurve curve = module.Measured(800, 45);
  curve.conditions.cells_in_series = 10;
  EXPECT_THAT(ErrorOfCurve(curve, options), HasSubstr("each of 10 stated cells"));
  curve = module.Measured(800, 45);
  for (double& current : curve.current_A) current *= 1000;
  options.coefficients.alpha_A_K = 4.6;
  const auto made = Prepare(curve, options, {});
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_EQ(made->doubts.size(), 1U);
  EXPECT_THAT(made->doubts[0], HasSubstr("more than any cell gives"));
}

TEST(Prepare, LeavesAStatedBandGapAlone) {
  const SyntheticModule module;
  TranslateOptions options = NoDiagnosis(module);
  options.coefficients.EgRef_eV = 1.2;
  const auto made = Prepare(module.Measured(800, 45), options, {});
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_FALSE(made->curve.bandgap);
  EXPECT_EQ(made->inputs.values.EgRef_eV, 1.2);
}

TEST(Prepare, RefusesReadingsWithoutTheirMaximumPower) {
  const SyntheticModule module;
  const TranslateOptions options = NoDiagnosis(module);
  IvCurve dark = module.Measured(800, 45), half = dark, reversed = dark;
  for (double& current : dark.current_A) current -= 20;
  EXPECT_THAT(ErrorOfCurve(dark, options), HasSubstr("no reading delivers power"));
  half.voltage_V.resize(40);
  half.current_A.resize(40);
  EXPECT_THAT(ErrorOfCurve(half, options), HasSubstr("before the point of maximum power"));
  std::reverse(reversed.voltage_V.begin(), reversed.voltage_V.end());
  std::reverse(reversed.current_A.begin(), reversed.current_A.end());
  EXPECT_EQ(ErrorOfCurve(reversed, options), "");
}

TEST(Prepare, RefusesCoefficientsAndLeadsOfNoDevice) {
  const SyntheticModule module;
  const IvCurve curve = module.Measured(800, 45);
  const auto with = [&](auto change) {
    TranslateOptions options = NoDiagnosis(module);
    change(&options);
    return ErrorOfCurve(curve, options);
  };
  EXPECT_THAT(with([](auto* o) { o->coefficients.alpha_A_K = 0.5; }),
              HasSubstr("alpha of 0.5 A/K"));
  EXPECT_THAT(with([](auto* o) { o->coefficients.beta_V_K = 0.1; }), HasSubstr("beta of 0.1 V/K"));
  EXPECT_THAT(with([](auto* o) { o->coefficients.beta_V_K = -30; }), HasSubstr("of no device"));
  EXPECT_THAT(with([](auto* o) { o->lead_resistance_ohm = 50; }), HasSubstr("leads of 50 ohm"));
}

TEST(Prepare, DoubtsLeadsWithMoreResistanceThanTheCurve) {
  const SyntheticModule module;
  TranslateOptions options = NoDiagnosis(module);
  options.lead_resistance_ohm = 0.5;
  const auto made = Prepare(module.Measured(800, 45), options, {});
  ASSERT_TRUE(made) << made.error().message;
  ASSERT_THAT(made->warnings, Not(IsEmpty()));
  EXPECT_THAT(made->warnings.front(), HasSubstr("leads"));
}

}  // namespace
}  // namespace lyrefit
