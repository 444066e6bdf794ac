#include "lyrefit/estimate/fit/polish_extended.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "effects/module_with.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/estimate/fit/simulate.h"
#include "repeats.h"
#include "studies/landscape.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

LandscapeCase Synthetic(const std::string& problem) {
  const auto cases = MakeLandscape(problem, 1, 5);
  EXPECT_TRUE(cases) << cases.error().ToString();
  return cases ? cases->front() : LandscapeCase{};
}

// Options with the named effect and no ranges for its parameters.
FitOptions ByName(const char* effect) {
  FitOptions options;
  options.with = {{FindEffect(effect), {}}};
  options.random_baseline = false;
  return options;
}

void ExpectNear(const FitReport& report, const std::string& symbol, double truth) {
  const Estimate& e = Find(report, symbol);
  EXPECT_NEAR(e.refined, truth, 5 * e.standard_error) << symbol;
}

TEST(PolishExtended, FindsAWeakCellAndItsReverseLaw) {
  const LandscapeCase made = Synthetic("weak_cell_soft");
  const auto report = Fit(made.curve, ByName("weak_cell"));
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_NEAR(report->rmse.refined.solved_current_A / made.noise_A, 1, 0.2);
  ExpectNear(*report, "weak_cell.d", made.truth.at("weak_cell.d"));
  ASSERT_EQ(report->variants.size(), 6u);
  int chosen = 0;
  for (const VariantReport& variant : report->variants) {
    EXPECT_GE(variant.bic_above, 0) << variant.what;
    if (!variant.chosen) continue;
    ++chosen;
    EXPECT_EQ(variant.bic_above, 0);
    EXPECT_TRUE(variant.finished);
    EXPECT_NEAR(variant.rmse_A / report->rmse.refined.solved_current_A, 1, 1e-9);
    EXPECT_THAT(variant.what, HasSubstr("A free"));  // soft reverse law
  }
  EXPECT_EQ(chosen, 1);
  EXPECT_TRUE(Find(*report, "weak_cell.a").fixed);
  EXPECT_FALSE(Find(*report, "weak_cell.A").fixed);
}

class StringsByName : public ::testing::TestWithParam<int> {};

TEST_P(StringsByName, ALightForEachSubstring) {
  const std::string substrings = std::to_string(GetParam());
  const LandscapeCase made = Synthetic("strings_" + substrings);
  ASSERT_EQ(made.curve.notes.bypass_diodes, GetParam());
  const auto report = Fit(made.curve, ByName("substrings"));
  ASSERT_TRUE(report) << report.error().ToString();
  EXPECT_NEAR(report->rmse.refined.solved_current_A / made.noise_A, 1, 0.2);
  std::vector<double> truth, found;
  for (int k = 1; k < GetParam(); ++k) {
    const std::string light = "substrings.d" + std::to_string(k);
    truth.push_back(made.truth.at(light));
    found.push_back(Find(*report, light).refined);
  }
  std::sort(truth.begin(), truth.end());
  std::sort(found.begin(), found.end());
  for (std::size_t k = 0; k < truth.size(); ++k) EXPECT_NEAR(found[k], truth[k], 0.02) << k;
}

INSTANTIATE_TEST_SUITE_P(Counted, StringsByName, ::testing::Values(3, 5));

// A simulated module with a known number of bypass diodes and with fixed parameters of the effect.
IvCurve ModuleOf(int substrings, const EffectUse& use) {
  SimulateOptions options = Module();
  options.noise_A = 0;
  auto taken = Simulate(options);
  EXPECT_TRUE(taken) << taken.error().ToString();
  taken->notes.bypass_diodes = substrings;
  options.taken = *taken;
  options.with = {use};
  options.noise_A = Module().noise_A;
  const auto curve = Simulate(options);
  EXPECT_TRUE(curve) << curve.error().ToString();
  return curve ? *curve : IvCurve{};
}

TEST(PolishExtended, TriesSharesOfWholeSubstrings) {
  const IvCurve curve =
      ModuleOf(5, {FindEffect("substrings"), {{"d1", {0.45, 0.45}}, {"w1", {0.4, 0.4}}}});
  FitOptions options = ByName("substrings");
  options.with[0].ranges = {{"d1", {0, 0.9}}, {"w1", {0.2, 0.8}}};
  const auto report = Fit(curve, options);
  ASSERT_TRUE(report) << report.error().ToString();
  const Estimate& share = Find(*report, "substrings.w1");
  EXPECT_DOUBLE_EQ(share.refined, 0.4);
  EXPECT_DOUBLE_EQ(share.bounds.whole, 0.2);
  ExpectNear(*report, "substrings.d1", 0.45);
  EXPECT_TRUE(report->variants.empty());  // the ranges leave one variant
}

TEST(PolishExtended, AShadesShareOfCountedSubstringsIsExactAndHasNoInterval) {
  const IvCurve curve =
      ModuleOf(3, {FindEffect("shading"), {{"d", {0.4, 0.4}}, {"w", {1.0 / 3, 1.0 / 3}}}});
  const auto report = Fit(curve, ByName("shading"));
  ASSERT_TRUE(report) << report.error().ToString();
  const Estimate& share = Find(*report, "shading.w");
  EXPECT_EQ(share.refined, 1.0 / 3);
  EXPECT_FALSE(share.fixed);
  EXPECT_FALSE(share.free());
  EXPECT_EQ(share.interval, IntervalMethod::kNone);
  EXPECT_TRUE(std::isnan(share.low_95));
  EXPECT_TRUE(std::isnan(share.standard_error));
  const Estimate& depth = Find(*report, "shading.d");
  EXPECT_NEAR(depth.refined, 0.4, 5 * depth.standard_error);
  EXPECT_LT(depth.low_95, depth.refined);
  EXPECT_GT(depth.high_95, depth.refined);
}

TEST(PolishExtended, GivesTheSameBitsOnAnyNumberOfThreads) {
  SKIP_IF_SANITIZED();
  const LandscapeCase made = Synthetic("strings_3");
  FitOptions options = ByName("substrings");
  options.search.seed = 11;
  options.threads = 1;
  const auto one = Fit(made.curve, options);
  options.threads = 3;
  const auto three = Fit(made.curve, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->searched, three->searched);
  EXPECT_EQ(one->refined, three->refined);
  ASSERT_EQ(one->refine.starts.size(), three->refine.starts.size());
  for (std::size_t s = 0; s < one->refine.starts.size(); ++s) {
    EXPECT_EQ(one->refine.starts[s].end_rmse_A, three->refine.starts[s].end_rmse_A) << s;
  }
  for (std::size_t i = 0; i < one->estimates.size(); ++i) {
    if (!one->estimates[i].free()) continue;
    EXPECT_EQ(one->estimates[i].low_95, three->estimates[i].low_95) << i;
    EXPECT_EQ(one->estimates[i].high_95, three->estimates[i].high_95) << i;
  }
}

TEST(PolishExtended, BeginsWhereItIsToldTo) {
  const LandscapeCase made = Synthetic("strings_3");
  FitOptions options = ByName("substrings");
  options.intervals = Intervals::kNone;
  const auto origins = [&](StartsFrom from) {
    options.starts = from;
    const auto report = Fit(made.curve, options);
    EXPECT_TRUE(report) << report.error().ToString();
    std::string list;
    for (const StartReport& start : report->refine.starts) list += start.origin + "\n";
    return list;
  };
  const std::string all = origins(StartsFrom::kAll);
  EXPECT_THAT(all, StartsWith("best candidate\n"));
  EXPECT_THAT(all, HasSubstr("shape 1\n"));
  const std::string shape = origins(StartsFrom::kShape);
  EXPECT_THAT(shape, StartsWith("shape 1\n"));
  for (const char* other : {"candidate", "elite", "random"}) {
    EXPECT_THAT(shape, Not(HasSubstr(other)));
  }
  const std::string search = origins(StartsFrom::kSearch);
  EXPECT_THAT(search, StartsWith("best candidate\n"));
  for (const char* other : {"shape", "probe"}) EXPECT_THAT(search, Not(HasSubstr(other)));
}

}  // namespace
}  // namespace lyrefit
