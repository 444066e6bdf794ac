#include "lyrefit/diagnose/known_effects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "diagnose/synthetic_diagnosis.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// A lamp that brightens and fades twice in a sweep. The catalogue has no such effect.
template <class T>
T Flicker(const T& x) {
  const T square = 4.0 * x * x;
  return 8.0 * square * square - 8.0 * square + 1.0;
}

Effect Lamp() {
  Effect lamp;
  lamp.id = "lamp";
  lamp.title = "flicker of the lamp";
  lamp.where = Where::kSweep;
  lamp.sentence = "the lamp flickers";
  lamp.parameters = {Parameter("a", "amplitude", "part of the light").Between(-0.2, 0.2)};
  lamp.conditions = [](const auto* p, const auto& reading, auto* conditions) {
    conditions->irradiance = conditions->irradiance * (1.0 + p[0] * Flicker(reading.x));
  };
  lamp.probes = [](const DataTraits&) { return std::vector<Probe>{{0.01}}; };
  return lamp;
}

constexpr double kAmplitude = 0.006;

IvCurve UnderTheLamp() {
  Recipe recipe;
  recipe.points = 80;
  IvCurve curve = SyntheticCurve(recipe);
  const double last = static_cast<double>(curve.size() - 1);
  // Beyond the knee the diode takes part of the additional photocurrent.
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  const std::vector<double> p = SyntheticParameters(recipe);
  const std::vector<double> steady = SolveCurrents(device, p.data(), curve.voltage_V);
  for (std::size_t k = 0; k < curve.size(); ++k) {
    std::vector<double> lit = p;
    lit[kIph] *= 1 + kAmplitude * Flicker(static_cast<double>(k) / last - 0.5);
    curve.current_A[k] +=
        SolveCurrents(device, lit.data(), std::vector<double>{curve.voltage_V[k]}).front() -
        steady[k];
  }
  return curve;
}

DiagnoseOptions With(const Effect& effect) {
  DiagnoseOptions options = Quick(LaboratoryOptions());
  options.own_effects = {&effect};
  return options;
}

TEST(KnownEffectsTest, AnEffectOfOnesOwnIsFoundBesideTheCatalogue) {
  const Effect lamp = Lamp();
  DiagnoseOptions options = With(lamp);
  options.held_out = true;
  options.folds = 4;
  const auto d = Diagnose(UnderTheLamp(), options);
  ASSERT_TRUE(d) << d.error().message;
  ASSERT_THAT(Ids(*d), testing::ElementsAre("lamp"));
  const Cause& cause = d->verdict.causes.front();
  EXPECT_EQ(cause.title, "flicker of the lamp");
  ASSERT_EQ(cause.strength.size(), 1U);
  EXPECT_LT(cause.strength[0].low_95, kAmplitude);
  EXPECT_GT(cause.strength[0].high_95, kAmplitude);
  EXPECT_LT(cause.strength[0].high_95 - cause.strength[0].low_95, 0.2 * kAmplitude);
  EXPECT_TRUE(d->gain.gain);
  ASSERT_EQ(d->trials.size(), Catalogue().size() + 1);
  EXPECT_EQ(d->trials.back().effect, "lamp");
  EXPECT_TRUE(d->trials.back().tried);
  EXPECT_EQ(d->extended.estimates.back().info.symbol, "lamp.a");
}

TEST(KnownEffectsTest, WithoutItTheCatalogueFindsSomethingElse) {
  const Effect lamp = Lamp();
  DiagnoseOptions options = With(lamp);
  options.own_effects.clear();
  const auto d = Diagnose(UnderTheLamp(), options);
  ASSERT_TRUE(d);
  EXPECT_TRUE(d->verdict.found);
  EXPECT_THAT(Ids(*d), Not(Contains("lamp")));
}

TEST(KnownEffectsTest, OnesOwnCanBeAskedForByItsId) {
  Effect lamp = Lamp();
  lamp.found_by = FoundBy::kRequest;
  DiagnoseOptions options = With(lamp);
  options.effects = {"lamp"};
  const auto known = KnownEffects(options);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->back(), &lamp);
  EXPECT_EQ(Candidates(*known, {}, options), std::vector<const Effect*>{&lamp});
  options.effects = {"drift"};
  EXPECT_THAT(Candidates(*known, {}, options), Not(Contains(&lamp)));
  options.effects.clear();
  EXPECT_THAT(Candidates(*known, {}, options), Not(Contains(&lamp)));
}

TEST(KnownEffectsTest, ABaseOfTwoDiodesHasTheSecondDiode) {
  DiagnoseOptions options;
  const Effect* second = FindEffect("second_diode");
  EXPECT_THAT(Candidates(Catalogue(), {}, options), Contains(second));
  options.base = Model::kDoubleDiode;
  EXPECT_THAT(Candidates(Catalogue(), {}, options), Not(Contains(second)));
}

std::string WhyRefused(const Effect& effect) {
  const auto known = KnownEffects(With(effect));
  return known ? "" : known.error().message;
}

TEST(KnownEffectsTest, RefusesWhatCannotBeFitted) {
  EXPECT_EQ(WhyRefused(Lamp()), "");
  Effect effect = Lamp();
  effect.id = "";
  EXPECT_THAT(WhyRefused(effect), HasSubstr("no id"));
  effect = Lamp();
  effect.id = "drift";
  EXPECT_THAT(WhyRefused(effect), HasSubstr("another effect has its id"));
  effect = Lamp();
  effect.parameters.clear();
  EXPECT_THAT(WhyRefused(effect), HasSubstr("no parameters"));
  effect = Lamp();
  effect.parameters.resize(30, effect.parameters.front());
  EXPECT_THAT(WhyRefused(effect), HasSubstr("too many"));
  for (const double upper : {-0.3, -0.1, std::numeric_limits<double>::infinity()}) {
    effect = Lamp();
    effect.parameters.front().upper = upper;
    EXPECT_THAT(WhyRefused(effect), HasSubstr("bounds of 'a'")) << upper;
  }
  effect = Lamp();
  effect.conditions = {};
  EXPECT_THAT(WhyRefused(effect), HasSubstr("no stage"));
  effect = Lamp();
  effect.probes = nullptr;
  EXPECT_THAT(WhyRefused(effect), HasSubstr("no probes"));
  effect = Lamp();
  effect.found_by = FoundBy::kWaves;
  EXPECT_THAT(WhyRefused(effect), HasSubstr("found by a fit"));
  DiagnoseOptions options;
  options.own_effects = {nullptr};
  EXPECT_FALSE(KnownEffects(options));
  options.own_effects = {};
  options.effects = {"lamp"};
  EXPECT_FALSE(Diagnose(SyntheticCurve({}), options));
}

}  // namespace
}  // namespace lyrefit
