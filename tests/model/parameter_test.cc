#include "lyrefit/model/parameter.h"

#include <gtest/gtest.h>

#include "lyrefit/model/translation.h"

namespace lyrefit {
namespace {

constexpr ParameterKind kEveryKind[] = {ParameterKind::kPlain,      ParameterKind::kPhotocurrent,
                                        ParameterKind::kSaturation, ParameterKind::kIdeality,
                                        ParameterKind::kSeries,     ParameterKind::kShunt,
                                        ParameterKind::kDarkShunt};

TEST(ToScale, GoesThereAndBackWithTheSlopeThatStepOnScaleSays) {
  for (const ParameterKind kind : kEveryKind) {
    const double value = 0.3, step = 1e-7;
    EXPECT_DOUBLE_EQ(FromScale(kind, ToScale(kind, value)), value);
    const double way = ToScale(kind, value + step) - ToScale(kind, value - step);
    EXPECT_NEAR(StepOnScale(kind, value, 2 * step) / std::fabs(way), 1, 1e-6);
  }
}

TEST(RangeAround, IsOrderedAndAsLongOnEitherSideOfTheScale) {
  for (const ParameterKind kind : kEveryKind) {
    const ParameterRange range = RangeAround(kind, 0.3, 0.1);
    EXPECT_LT(range.low, 0.3);
    EXPECT_GT(range.high, 0.3);
    EXPECT_NEAR(ToScale(kind, range.low) + ToScale(kind, range.high), 2 * ToScale(kind, 0.3),
                1e-14);
  }
  EXPECT_GT(RangeAround(ParameterKind::kSaturation, 1e-9, 1e-7).low, 0);
}

TEST(RangeAround, HasNoUpperEndForAShuntThatMayBePerfect) {
  EXPECT_TRUE(std::isinf(RangeAround(ParameterKind::kShunt, 300, 301).high));
  EXPECT_NEAR(RangeAround(ParameterKind::kShunt, 300, 150).high, 600, 1e-10);
}

TEST(ParameterInfo, SaysWhatGoesWithWhat) {
  TranslationSpec spec;
  spec.law = TranslationLaw::kPvsyst;
  spec.model = Model::kDoubleDiode;
  spec.shunt = ShuntLaw::kExponential;
  const Translation law = *MakeTranslation(spec);
  const auto& of = law.parameters;
  EXPECT_EQ(of[law.saturation_current].with[0], law.n);
  EXPECT_EQ(of[law.saturation_current_2].with[0], law.n_2);
  EXPECT_EQ(of[law.resistance_shunt_dark].with[0], law.resistance_shunt);
  EXPECT_EQ(of[law.resistance_shunt_dark].with[1], law.shunt_exponent);
  const Device device = MakeDevice(Model::kTripleDiode, {});
  for (int diode = 0; diode < 3; ++diode) {
    const ParameterInfo& is = device.parameters[SaturationCurrentIndex(diode)];
    EXPECT_EQ(is.kind, ParameterKind::kSaturation);
    EXPECT_EQ(is.with[0], IdealityIndex(diode));
    EXPECT_EQ(device.parameters[IdealityIndex(diode)].kind, ParameterKind::kIdeality);
  }
}

}  // namespace
}  // namespace lyrefit
