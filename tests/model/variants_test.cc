#include "lyrefit/model/variants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "effects/synthetic_use.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

// One sweep of a module whose second half is limited to half of the current. `diodes`: number of
// bypass diodes, or 0 for unknown.
IvCurve SteppedModule(int diodes) {
  const std::vector<double> module = {8.2, 2e-9, 1.15, 0.25, 300};
  IvCurve curve;
  curve.name = "made";
  curve.conditions.cells_in_series = 60;
  if (diodes > 0) curve.notes.bypass_diodes = diodes;
  for (int k = 0; k < 80; ++k) curve.voltage_V.push_back(39.0 * k / 79);
  const Device device = MakeDevice(Model::kSingleDiode, curve.conditions);
  curve.current_A = SolveCurrents(device, module.data(), curve.voltage_V);
  for (int k = 40; k < 80; ++k) curve.current_A[k] = std::min(curve.current_A[k], 4.1);
  return curve;
}

DeviceEffects Extended(const IvCurve& curve, const std::vector<EffectUse>& uses) {
  const auto device = Extend(MakeDevice(Model::kSingleDiode, curve.conditions), Model::kSingleDiode,
                             ConstantSet::kCodata, curve, uses, /*force=*/true);
  EXPECT_TRUE(device) << device.error().ToString();
  return device ? *device->effects : DeviceEffects{};
}

std::vector<std::string> Descriptions(const DeviceEffects& device_effects) {
  std::vector<std::string> list;
  for (const Variant& variant : VariantsOf(device_effects))
    list.push_back(DescribeVariant(device_effects, variant));
  return list;
}

TEST(Variants, AWeakCellHasOneForEachReverseLawAndNumberOfChains) {
  const DeviceEffects device_effects = Extended(SteppedModule(3), {UseOf("weak_cell")});
  EXPECT_THAT(Descriptions(device_effects),
              UnorderedElementsAre("d, Vb, m, A free", "d, Vb, m, A free; chains = 2",
                                   "d, Vb, a, Vbr free", "d, Vb, a, Vbr free; chains = 2",
                                   "d, Vb free; a = 0", "d, Vb free; a = 0, chains = 2"));
  for (const Variant& variant : VariantsOf(device_effects)) {
    const bool no_law = DescribeVariant(device_effects, variant).find("a = 0") != std::string::npos;
    EXPECT_EQ(variant.free, no_law ? 2 : 4);
  }
}

class SubstringsVariants : public ::testing::TestWithParam<int> {};

TEST_P(SubstringsVariants, HaveALightForEachThatIsCountedButTheBrightest) {
  const int diodes = GetParam();
  const int groups = diodes - 1;
  const DeviceEffects device_effects = Extended(SteppedModule(diodes), {UseOf("substrings")});
  const std::vector<Variant> variants = VariantsOf(device_effects);
  // Shading covers all cells of a substring or, with fewer than four groups, also a part of them.
  ASSERT_EQ(variants.size(), groups < 4 ? 2u : 1u);
  EXPECT_EQ(variants[0].free, groups + 1);
  EXPECT_EQ(variants.back().free, groups + (groups < 4 ? 2 : 1));
  for (const Variant& variant : variants) {
    for (int k = 0; k < 4; ++k) {
      const ParameterBounds& light = variant.bounds[2 * k];
      EXPECT_EQ(light.lower < light.upper, k < groups) << k;
      EXPECT_DOUBLE_EQ(variant.usual[2 * k + 1], k < groups ? 1.0 / diodes : 0) << k;
      EXPECT_EQ(variant.bounds[2 * k + 1].lower, variant.bounds[2 * k + 1].upper) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Counted, SubstringsVariants, ::testing::Values(2, 3, 4, 5));

TEST(Variants, ASharesWholeSubstringsStayFree) {
  const DeviceEffects device_effects = Extended(SteppedModule(5), {UseOf("shading")});
  const std::vector<Variant> variants = VariantsOf(device_effects);
  EXPECT_THAT(Descriptions(device_effects),
              UnorderedElementsAre("d, w, Vb free", "d, w, Vb, c free"));
  for (const Variant& variant : variants) {
    EXPECT_DOUBLE_EQ(variant.bounds[1].lower, 0.2);
    EXPECT_DOUBLE_EQ(variant.bounds[1].upper, 0.8);
    EXPECT_DOUBLE_EQ(variant.bounds[1].whole, 0.2);
  }
  // With an unknown number of substrings, the share is continuous.
  for (const Variant& variant : VariantsOf(Extended(SteppedModule(0), {UseOf("shading")}))) {
    EXPECT_EQ(variant.bounds[1].whole, 0);
  }
}

TEST(Variants, RangesLeaveOne) {
  const DeviceEffects device_effects =
      Extended(SteppedModule(3), {UseOf("weak_cell", {{"d", {0.1, 0.9}}})});
  const std::vector<Variant> variants = VariantsOf(device_effects);
  ASSERT_EQ(variants.size(), 1u);
  EXPECT_EQ(variants[0].free, 1);
  EXPECT_EQ(variants[0].usual, device_effects.usual);
  EXPECT_EQ(variants[0].bounds[0].lower, 0.1);
  EXPECT_EQ(variants[0].bounds[0].upper, 0.9);
}

TEST(Variants, OfTwoEffectsAreAllPairs) {
  const DeviceEffects device_effects =
      Extended(SteppedModule(3), {UseOf("shading"), UseOf("nonohmic_shunt")});
  EXPECT_EQ(VariantsOf(device_effects).size(), 2u);  // a shunt has one variant
  for (const std::string& what : Descriptions(device_effects)) {
    EXPECT_THAT(what, HasSubstr("shading.d, shading.w, shading.Vb"));
    EXPECT_THAT(what, HasSubstr("nonohmic_shunt.k"));
  }
}

TEST(Variants, PlacesOfAShapeAreInsideTheirBounds) {
  for (const Effect* effect : Catalogue()) {
    if (effect->starts == nullptr) continue;
    for (const int diodes : {0, 3, 4}) {
      const DeviceEffects device_effects = Extended(SteppedModule(diodes), {{effect, {}}});
      for (const Variant& variant : VariantsOf(device_effects)) {
        const std::vector<std::vector<double>> places = ShapePlaces(device_effects, variant);
        EXPECT_FALSE(places.empty())
            << effect->id << ", " << DescribeVariant(device_effects, variant);
        for (const std::vector<double>& place : places) {
          ASSERT_EQ(place.size(), variant.bounds.size());
          for (std::size_t k = 0; k < place.size(); ++k) {
            EXPECT_DOUBLE_EQ(place[k], WithinBounds(variant.bounds[k], place[k]))
                << effect->id << "." << effect->parameters[k].symbol;
          }
        }
      }
    }
  }
}

TEST(Variants, APlaceOfAShapeSeesTheStep) {
  const DeviceEffects device_effects = Extended(SteppedModule(2), {UseOf("shading")});
  const std::vector<std::vector<double>> places =
      ShapePlaces(device_effects, VariantsOf(device_effects).front());
  ASSERT_EQ(places.size(), 1u);
  EXPECT_NEAR(places[0][0], 0.5, 0.03);  // deficit: half of the light
  EXPECT_DOUBLE_EQ(places[0][1], 0.5);   // share: half of the cells
}

TEST(Variants, SharesLeaveARest) {
  const DeviceEffects device_effects =
      Extended(SteppedModule(5), {UseOf("substrings", {{"d1", {0, 0.9}},
                                                       {"w1", {0.2, 0.8}},
                                                       {"d2", {0, 0.9}},
                                                       {"w2", {0.2, 0.8}},
                                                       {"d3", {0, 0.9}},
                                                       {"w3", {0.2, 0.8}}})});
  std::vector<double> p = device_effects.usual;
  const auto leave = [&](double w1, double w2, double w3) {
    p[1] = w1, p[3] = w2, p[5] = w3;
    LeaveARest(device_effects, device_effects.bounds, p.data());
    return std::vector<double>{p[1], p[3], p[5]};
  };
  using ::testing::DoubleNear;
  using ::testing::ElementsAre;
  const auto about = [](double share) { return DoubleNear(share, 1e-12); };
  // The largest share loses one substring at a time until one substring remains without a share.
  EXPECT_THAT(leave(0.8, 0.2, 0.2), ElementsAre(about(0.4), about(0.2), about(0.2)));
  EXPECT_THAT(leave(0.2, 0.2, 0.6), ElementsAre(about(0.2), about(0.2), about(0.4)));
  EXPECT_THAT(leave(0.4, 0.2, 0.2), ElementsAre(0.4, 0.2, 0.2));
}

TEST(Variants, SharesThatAreNoWholeNumbersLeaveARestToo) {
  const DeviceEffects device_effects = Extended(
      SteppedModule(0),
      {UseOf("substrings",
             {{"d1", {0, 0.9}}, {"w1", {0.1, 0.9}}, {"d2", {0, 0.9}}, {"w2", {0.1, 0.9}}})});
  std::vector<double> p = device_effects.usual;
  p[1] = 0.7, p[3] = 0.5;
  LeaveARest(device_effects, device_effects.bounds, p.data());
  EXPECT_DOUBLE_EQ(p[1], 0.35);
  EXPECT_DOUBLE_EQ(p[3], 0.5);
}

}  // namespace
}  // namespace lyrefit
