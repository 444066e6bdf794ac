#include "lyrefit/estimate/fit/search_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "lyrefit/base/random.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "module_with.h"

namespace lyrefit {
namespace {

TEST(SearchSpace, IsLinearLogarithmicOrFixedAsTheBoundsSay) {
  std::vector<ParameterBounds> bounds(3);
  bounds[0] = {0, 4, 1, 3, SearchScale::kLinear};
  bounds[1] = {0, 1, 1e-10, 1e-4, SearchScale::kLog};
  bounds[2] = {0, 9, 0, 9, SearchScale::kLinear};
  const SearchSpace space(bounds, {std::nan(""), std::nan(""), 5});
  ASSERT_EQ(space.dimensions(), 2);
  EXPECT_EQ(space.box().lower, (std::vector<double>{1, 0}));
  EXPECT_NEAR(space.box().upper[1], std::log(1e6), 1e-12);
  double p[3];
  const double x[] = {2.5, 0.5 * space.box().upper[1]};
  space.ToParameters(x, p);
  EXPECT_EQ(p[0], 2.5);
  EXPECT_NEAR(p[1], 1e-7, 1e-19);
  EXPECT_EQ(p[2], 5);
}

TEST(SearchSpace, GivesEveryWholeNumberAsMuchRoom) {
  const ParameterBounds counted{2, 5, 2, 5, SearchScale::kLinear, 1};
  const SearchSpace space({counted}, {std::nan("")});
  ASSERT_EQ(space.dimensions(), 1);
  EXPECT_EQ(space.box().lower[0], 0);
  EXPECT_EQ(space.box().upper[0], 4);
  std::map<double, int> met;
  for (int k = 0; k < 400; ++k) {
    const double x = (k + 0.5) / 100;
    double p = 0;
    space.ToParameters(&x, &p);
    ++met[p];
  }
  EXPECT_EQ(met, (std::map<double, int>{{2, 100}, {3, 100}, {4, 100}, {5, 100}}));
  double p = 0;
  space.ToParameters(&space.box().upper[0], &p);  // the upper end maps to the last number
  EXPECT_EQ(p, 5);
}

// A module of three substrings with the named effect and no ranges.
Device ModuleWith(const char* effect) {
  auto curve = Simulate(Module());
  EXPECT_TRUE(curve) << curve.error().ToString();
  curve->notes.bypass_diodes = 3;
  const auto device =
      Extend(MakeDevice(Model::kSingleDiode, curve->conditions), Model::kSingleDiode,
             ConstantSet::kCodata, *curve, {{FindEffect(effect), {}}}, /*force=*/true);
  EXPECT_TRUE(device) << device.error().ToString();
  return *device;
}

TEST(SearchSpace, HasASideForTheVariantsOfEffects) {
  const Device device = ModuleWith("weak_cell");
  const DeviceEffects& device_effects = *device.effects;
  const std::vector<Variant> variants = VariantsOf(device_effects);
  ASSERT_GT(variants.size(), 2u);
  const std::vector<ParameterBounds> base(5, {0, 1, 0, 1, SearchScale::kLinear});
  const SearchSpace space(base, std::vector<double>(5, std::nan("")), device_effects, variants);
  // Five parameters of the diode, all that are free in some variant (d, Vb, a, Vbr, m, A), and the
  // variant.
  ASSERT_EQ(space.dimensions(), 12);
  EXPECT_EQ(space.box().upper.back(), static_cast<double>(variants.size()));
  std::vector<double> x, p(device.size());
  for (int j = 0; j < space.dimensions(); ++j) {
    x.push_back(0.5 * (space.box().lower[j] + space.box().upper[j]));
  }
  for (std::size_t f = 0; f < variants.size(); ++f) {
    x.back() = static_cast<double>(f) + 0.5;
    ASSERT_EQ(space.VariantAt(x.data()), static_cast<int>(f));
    space.ToParameters(x.data(), p.data());
    for (int i = 0; i < 5; ++i) EXPECT_EQ(p[i], 0.5);
    for (std::size_t k = 0; k < variants[f].bounds.size(); ++k) {
      const ParameterBounds& own = variants[f].bounds[k];
      EXPECT_EQ(p[5 + k], WithinBounds(own, p[5 + k])) << k;
      if (own.lower == own.upper) continue;
      EXPECT_DOUBLE_EQ(p[5 + k], 0.5 * (own.lower + own.upper)) << k;
    }
  }
}

TEST(SearchSpace, SharesOfSubstringsAreSearchedAsWholeNumbersOfThem) {
  const Device device = ModuleWith("shading");
  const DeviceEffects& device_effects = *device.effects;
  const std::vector<ParameterBounds> base(5, {0, 1, 0, 1, SearchScale::kLinear});
  const SearchSpace space(base, std::vector<double>(5, 0.5), device_effects,
                          VariantsOf(device_effects));
  ASSERT_EQ(space.dimensions(), 5);  // d, w, Vb, c and the variant
  EXPECT_EQ(space.box().lower[1], 0);
  EXPECT_EQ(space.box().upper[1], 2);
  std::vector<double> x = {0.5, 0, 0.5, 0.5, 0.5}, p(device.size());
  for (const auto& [at, share] : {std::pair{0.3, 1.0 / 3}, {0.99, 1.0 / 3}, {1.01, 2.0 / 3}}) {
    x[1] = at;
    space.ToParameters(x.data(), p.data());
    EXPECT_DOUBLE_EQ(p[6], share) << at;
  }
}

TEST(SearchSpace, LeadsBackFromParameters) {
  std::vector<ParameterBounds> bounds(4);
  bounds[0] = {0, 4, 1, 3, SearchScale::kLinear};
  bounds[1] = {0, 1, 1e-10, 1e-4, SearchScale::kLog};
  bounds[2] = {0, 9, 0, 9, SearchScale::kLinear};
  bounds[3] = {1, 5, 1, 5, SearchScale::kLinear, 1};
  const SearchSpace space(bounds, {std::nan(""), std::nan(""), 5, std::nan("")});
  RandomStream random(1, 0);
  for (int k = 0; k < 100; ++k) {
    double x[3], p[4], again[4];
    for (int j = 0; j < 3; ++j)
      x[j] =
          space.box().lower[j] + random.Uniform() * (space.box().upper[j] - space.box().lower[j]);
    space.ToParameters(x, p);
    space.ToParameters(space.FromParameters(p, 0).data(), again);
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(again[i] / p[i], 1, 1e-13);
  }
  const double outside[] = {9, 0, 5, 7};
  EXPECT_EQ(space.FromParameters(outside, 0), (std::vector<double>{3, 0, 5}));
}

// Effects without ranges have several variants, whole numbers of substrings and shares that limit
// each other.
TEST(SearchSpace, LeadsBackFromTheParametersOfEveryVariant) {
  SimulateOptions made;
  made.parameters = {{"Iph", 8.2}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.25}, {"Rsh", 300}};
  made.conditions.cells_in_series = 60;
  made.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto curve = Simulate(made);
  ASSERT_TRUE(curve);
  for (const char* effect : {"weak_cell", "substrings", "shading"}) {
    FitOptions options;
    options.with = {{FindEffect(effect), {}}};
    const auto prepared = PrepareFit(*curve, options);
    ASSERT_TRUE(prepared);
    const SearchSpace space = SpaceOf(*prepared);
    RandomStream random(2, 0);
    std::vector<double> p(prepared->device.size()), again(p.size());
    std::vector<int> variants(prepared->variants.size(), 0);
    for (int k = 0; k < 300; ++k) {
      std::vector<double> x;
      for (int j = 0; j < space.dimensions(); ++j) {
        x.push_back(space.box().lower[j] +
                    random.Uniform() * (space.box().upper[j] - space.box().lower[j]));
      }
      space.ToParameters(x.data(), p.data());
      const int variant = space.VariantAt(x.data());
      ++variants[variant];
      const std::vector<double> back = space.FromParameters(p.data(), variant);
      EXPECT_EQ(space.VariantAt(back.data()), variant);
      space.ToParameters(back.data(), again.data());
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_NEAR(again[i], p[i], 1e-12 * std::fabs(p[i])) << effect << " " << i;
      }
    }
    for (const int met : variants) EXPECT_GT(met, 0);
  }
}

}  // namespace
}  // namespace lyrefit
