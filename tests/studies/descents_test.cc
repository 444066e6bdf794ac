#include "lyrefit/estimate/fit/descents.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/estimate/fit/prepare_fit.h"
#include "lyrefit/model/reporting_units.h"
#include "studies/landscape.h"

namespace lyrefit {
namespace {

// A simulated module of four substrings, each under its own light, and the prepared fit of the
// effect `substrings` without ranges.
class DescentsTest : public ::testing::Test {
 protected:
  static FitOptions WithSubstrings() {
    FitOptions options;
    options.with = {{FindEffect("substrings"), {}}};
    return options;
  }

  // The true parameters, in the variant in which shades cover all cells of a substring.
  PolishStart Truth() const {
    std::vector<double> p = fit_.variants[0].usual;
    p.insert(p.begin(), fit_.base_size(), 1);
    p = Reported(fit_.device, p);
    for (int i = 0; i < fit_.device.size(); ++i) {
      const auto known = synthetic_.truth.find(fit_.device.parameters[i].symbol);
      if (known != synthetic_.truth.end()) p[i] = known->second;
    }
    return {"truth", Internal(fit_.device, p), 0};
  }
  // The true parameters with other shading depths.
  PolishStart Changed(double d1, double d2, double d3) const {
    PolishStart start = Truth();
    double* const own = start.p.data() + fit_.base_size();
    own[0] = d1, own[2] = d2, own[4] = d3;
    return start;
  }

  const LandscapeCase synthetic_ = MakeLandscape("strings_4", 1, 3).value().front();
  const FitOptions options_ = WithSubstrings();
  const PreparedFit fit_ = PrepareFit(synthetic_.curve, options_).value();
  const ProgressReporter progress_ = {};
};

TEST_F(DescentsTest, TheShapesPlacesLeadToTheOptimumOfTheTruth) {
  const PolishStart truth = Truth();
  const RefineEnd end = Refine(InVariant(fit_.problem, fit_.variants[0], truth.p), truth.p);
  EXPECT_NEAR(std::sqrt(end.mean_square) / synthetic_.noise_A, 1, 0.2);
  Descents descents;
  Descend(fit_, ShapeStarts(fit_), progress_, &descents);
  const DescentEnd& best = descents.Best();
  EXPECT_TRUE(best.finished);
  EXPECT_EQ(best.start.variant, 0);
  EXPECT_NEAR(best.end.mean_square / end.mean_square, 1, 1e-6);
  for (const DescentEnd& other : descents.ends) EXPECT_GE(other.value, best.value);
}

TEST_F(DescentsTest, WhatAVariantFreesIsPaidFor) {
  Descents descents;
  Descend(fit_, ShapeStarts(fit_), progress_, &descents);
  const double points = static_cast<double>(synthetic_.curve.size());
  for (const DescentEnd& end : descents.ends) {
    const double free = fit_.variants[end.start.variant].free;
    EXPECT_NEAR(points * std::log(end.value / end.end.mean_square), free * std::log(points), 1e-6);
  }
}

TEST_F(DescentsTest, CountsWhatWasMet) {
  Descents descents;
  const double d1 = synthetic_.truth.at("substrings.d1");
  const double d2 = synthetic_.truth.at("substrings.d2");
  const double d3 = synthetic_.truth.at("substrings.d3");
  // Equal cell groups are interchangeable, so both starts end in one local optimum.
  Descend(fit_, {Changed(d1, d2, d3), Changed(d3, d1, d2)}, progress_, &descents);
  OptimumCount count = CountOptima(descents);
  EXPECT_EQ(count.ends, 2);
  EXPECT_EQ(count.local_optima, 1);
  EXPECT_EQ(count.best_visits, 2);
  EXPECT_EQ(count.independent.once, 0);
  EXPECT_EQ(count.independent.twice, 1);
  EXPECT_FALSE(std::isfinite(count.unseen));  // two ends are too few
  EXPECT_EQ(BestVisits(descents), 2);
  // A start far from the truth is given up, and not counted unless it was finished.
  Descend(fit_, {Changed(0.02, 0.02, 0.02)}, progress_, &descents);
  ASSERT_EQ(descents.ends.size(), 3u);
  count = CountOptima(descents);
  EXPECT_EQ(count.ends, descents.ends[2].finished ? 3 : 2);
}

TEST_F(DescentsTest, WhatBeganBesideAnEarlierEndIsInNoEstimate) {
  Descents descents;
  const double d1 = synthetic_.truth.at("substrings.d1");
  const double d2 = synthetic_.truth.at("substrings.d2");
  const double d3 = synthetic_.truth.at("substrings.d3");
  Descend(fit_, {Changed(d1, d2, d3)}, progress_, &descents);
  PolishStart beside = Changed(d3, d1, d2);
  beside.beside = true;
  Descend(fit_, {beside}, progress_, &descents);
  const OptimumCount count = CountOptima(descents);
  EXPECT_EQ(count.ends, 2);
  EXPECT_EQ(count.best_visits, 2);
  EXPECT_EQ(count.independent.ends, 1);
  EXPECT_EQ(count.independent.local_optima, 1);
  EXPECT_EQ(count.independent.best_visits, 1);
  EXPECT_EQ(count.independent.once, 1);
  EXPECT_EQ(count.independent.twice, 0);
  EXPECT_FALSE(std::isfinite(count.unseen));
  for (const PolishStart& start : Neighbours(fit_, descents.Best())) {
    EXPECT_TRUE(start.beside) << start.origin;
  }
  for (const PolishStart& start : ShapeStarts(fit_)) EXPECT_FALSE(start.beside) << start.origin;
}

TEST_F(DescentsTest, AnEndIsTriedInEveryOtherVariant) {
  ASSERT_EQ(fit_.variants.size(), 2u);
  Descents descents;
  Descend(fit_, {Truth()}, progress_, &descents);
  const DescentEnd& end = descents.ends[0];
  int others = 0;
  for (const PolishStart& start : Neighbours(fit_, end)) {
    if (start.variant == end.start.variant) continue;
    ++others;
    EXPECT_EQ(start.variant, 1);
    EXPECT_EQ(start.origin, "another variant");
    for (int i = 0; i < fit_.base_size(); ++i) EXPECT_EQ(start.p[i], end.end.p[i]);
    for (int k = 0; k < fit_.effects_size(); ++k) {
      const ParameterBounds& bounds = fit_.variants[1].bounds[k];
      const double value = start.p[fit_.base_size() + k];
      EXPECT_GE(value, bounds.lower) << k;
      EXPECT_LE(value, bounds.upper) << k;
      const ParameterBounds& before = fit_.variants[0].bounds[k];
      if (before.lower == before.upper) {
        EXPECT_EQ(value, fit_.variants[1].usual[k]) << k;
      }
    }
  }
  EXPECT_EQ(others, 1);
}

TEST_F(DescentsTest, EstimatesTheUnseenAsChaoDoes) {
  std::vector<PolishStart> starts = ShapeStarts(fit_);  // two variants
  for (const double light : {0.02, 0.3, 0.6, 0.9}) starts.push_back(Changed(light, 0.3, 0.9));
  // One start that leads into each of three local optima, keyed by the objective at its end.
  std::map<double, PolishStart> into;
  for (std::size_t k = 0; k < starts.size() && into.size() < 3; ++k) {
    const PolishStart& start = starts[k];
    Descents alone;
    Descend(fit_, {start}, progress_, &alone);
    const double end = alone.ends[0].value;
    const bool known = std::any_of(into.begin(), into.end(), [&](const auto& other) {
      return std::fabs(other.first / end - 1) < 0.01;
    });
    if (!known) into[end] = start;
  }
  ASSERT_EQ(into.size(), 3u);
  // The worst first, so that no descent is given up for a better known end.
  Descents descents;
  for (auto start = into.rbegin(); start != into.rend(); ++start)
    Descend(fit_, {start->second}, progress_, &descents);
  OptimumCount count = CountOptima(descents);
  EXPECT_EQ(count.local_optima, 3);
  EXPECT_EQ(count.independent.once, 3);
  EXPECT_EQ(count.independent.twice, 0);
  EXPECT_EQ(count.unseen, 3);  // 3 x 2 / (2 x 1)
  Descend(fit_, {into.begin()->second}, progress_, &descents);
  count = CountOptima(descents);
  EXPECT_EQ(count.ends, 4);
  EXPECT_EQ(count.local_optima, 3);
  EXPECT_EQ(count.best_visits, 2);
  EXPECT_EQ(count.independent.once, 2);
  EXPECT_EQ(count.independent.twice, 1);
  EXPECT_EQ(count.unseen, 0.5);  // 2 x 1 / (2 x 2)
}

}  // namespace
}  // namespace lyrefit
