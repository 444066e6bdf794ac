#include "lyrefit/translate/extended_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "synthetic_string.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

FitReport PlainFit(const IvCurve& curve) {
  FitOptions options;
  options.intervals = Intervals::kNone;
  options.random_baseline = false;
  return *Fit(curve, options);
}

// Without effects the extended model is De Soto's law.
TEST(ExtendedModel, OfAReferenceModuleIsDeSotosLaw) {
  const SyntheticModule module;
  const IvCurve curve = module.Measured(700, 40);
  const ExtendedInputs inputs = {module.Inputs(700, 40), true};
  const auto model = MakeExtendedModel(curve, PlainFit(curve), inputs);
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_TRUE((*model)->kept.empty() && (*model)->removed.empty());
  ASSERT_TRUE((*model)->bandgap);
  PreparedCurve prepared = module.Curve(700, 40, {});
  prepared.models = {*model};
  const auto key = ExtendedKeyPoints(prepared, inputs.inputs, 0);
  ASSERT_TRUE(key) << key.error().message;
  const KeyPoints truth = module.Truth(1000, 25);
  EXPECT_NEAR(key->max_power_W, truth.max_power_W, 3e-3 * truth.max_power_W);
  EXPECT_NEAR(key->open_circuit_voltage_V, truth.open_circuit_voltage_V,
              2e-3 * truth.open_circuit_voltage_V);
  const auto points = ExtendedPoints(prepared, inputs.inputs, 0);
  ASSERT_TRUE(points);
  EXPECT_GT(points->voltage_V.size(), 100U);
  EXPECT_LT(points->current_A.back(), 0);
}

TEST(ExtendedModel, RefusesWhatIsNoModel) {
  const SyntheticModule module;
  const IvCurve curve = module.Measured(700, 40);
  const ExtendedInputs inputs = {module.Inputs(700, 40), true};
  FitReport fit = PlainFit(curve);
  fit.usable = false;
  EXPECT_THAT(MakeExtendedModel(curve, fit, inputs).error().message, HasSubstr("not usable"));
  fit.usable = true;
  fit.curves = 2;
  EXPECT_THAT(MakeExtendedModel(curve, fit, inputs).error().message, HasSubstr("several curves"));
  const PreparedCurve none = module.Curve(700, 40, {});
  EXPECT_FALSE(ExtendedKeyPoints(none, inputs.inputs, 0));
  EXPECT_FALSE(ExtendedPoints(none, inputs.inputs, 3));
}

// Effects of the device are kept; effects of the sweep are removed.
TEST(ExtendedModel, TellsTheDeviceFromTheSweep) {
  const SyntheticModule module;
  const IvCurve curve = module.Measured(700, 40);
  FitReport fit = PlainFit(curve);
  fit.causes = {"outliers", "no such thing"};
  const auto model = MakeExtendedModel(curve, fit, {module.Inputs(700, 40), true});
  ASSERT_TRUE(model) << model.error().message;
  EXPECT_EQ((*model)->cause, "outliers");
  EXPECT_EQ((*model)->removed.size() + (*model)->kept.size(), 1U);
  EXPECT_EQ((*model)->kept.size(), FindEffect("outliers")->where == Where::kDevice ? 1U : 0U);
}

}  // namespace
}  // namespace lyrefit
