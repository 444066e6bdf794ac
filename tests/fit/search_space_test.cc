#include "lyrefit/fit/search_space.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lyrefit/base/random.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/fit/birds.h"
#include "lyrefit/fit/simulate.h"

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

// A weak cell by its name alone: several forms, whole numbers, shares that leave a rest.
TEST(SearchSpace, LeadsBackFromTheParametersOfEveryForm) {
  SimulateOptions made;
  made.parameters = {{"Iph", 8.2}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.25}, {"Rsh", 300}};
  made.conditions.cells_in_series = 60;
  made.with = {{FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}}};
  const auto curve = Simulate(made);
  ASSERT_TRUE(curve);
  for (const char* effect : {"weak_cell", "substrings", "shading"}) {
    FitOptions options;
    options.with = {{FindEffect(effect), {}}};
    const Observer none;
    FitReport report;
    FitJob job{*curve, options, none, {}, {}, 0, {}, {}, FitWatch(none), {}};
    ASSERT_TRUE(PrepareFit(&job, &report));
    const SearchSpace space = CompleteSpace(job);
    RandomStream random(2, 0);
    std::vector<double> p(report.device.size()), again(p.size());
    std::vector<int> forms(job.forms.size(), 0);
    for (int k = 0; k < 300; ++k) {
      std::vector<double> x;
      for (int j = 0; j < space.dimensions(); ++j) {
        x.push_back(space.box().lower[j] +
                    random.Uniform() * (space.box().upper[j] - space.box().lower[j]));
      }
      space.ToParameters(x.data(), p.data());
      const int form = space.FormAt(x.data());
      ++forms[form];
      const std::vector<double> back = space.FromParameters(p.data(), form);
      EXPECT_EQ(space.FormAt(back.data()), form);
      space.ToParameters(back.data(), again.data());
      for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_NEAR(again[i], p[i], 1e-12 * std::fabs(p[i])) << effect << " " << i;
      }
    }
    for (const int met : forms) EXPECT_GT(met, 0);
  }
}

}  // namespace
}  // namespace lyrefit
