#include "lyrefit/fit/basins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/effects/catalogue.h"
#include "lyrefit/fit/basin_starts.h"
#include "lyrefit/fit/fit_job.h"
#include "lyrefit/fit/form_problem.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/study/landscape.h"

namespace lyrefit {
namespace {

// A module of four substrings under a light each, made, and what a fit by name makes ready of it.
class BasinsTest : public ::testing::Test {
 protected:
  BasinsTest() : made_(MakeLandscape("strings_4", 1, 3).value().front()) {
    options_.with = {{FindEffect("substrings"), {}}};
    const auto ready = PrepareFit(&job_, &report_);
    EXPECT_TRUE(ready) << ready.error().ToString();
  }

  // The values it was made with, under the form where shades cover all cells of a substring.
  PolishStart Truth() const {
    std::vector<double> p = job_.forms[0].usual;
    p.insert(p.begin(), job_.base_size(), 1);
    p = Reported(report_.device, p);
    for (int i = 0; i < report_.device.size(); ++i) {
      const auto known = made_.truth.find(report_.device.parameters[i].symbol);
      if (known != made_.truth.end()) p[i] = known->second;
    }
    return {"truth", Inner(report_.device, p), 0};
  }
  // The same with two lights exchanged, or with one that all share.
  PolishStart Changed(double d1, double d2, double d3) const {
    PolishStart start = Truth();
    double* const own = start.p.data() + job_.base_size();
    own[0] = d1, own[2] = d2, own[4] = d3;
    return start;
  }

  LandscapeCase made_;
  FitOptions options_;
  Observer observer_;
  FitJob job_{made_.curve, options_, observer_, {}, {}, 0, {}, {}, FitWatch(observer_), {}};
  FitReport report_;
};

TEST_F(BasinsTest, TheShapesPlacesLeadToTheOptimumOfTheTruth) {
  const PolishStart truth = Truth();
  const RefineEnd end = Refine(InForm(job_.problem, job_.forms[0], truth.p), truth.p);
  EXPECT_NEAR(std::sqrt(end.mean_square) / made_.noise_A, 1, 0.2);
  Basins basins(job_.problem, job_.forms, &job_.watch);
  basins.Descend(ShapeStarts(job_));
  const BasinEnd& best = basins.ends()[basins.best()];
  EXPECT_TRUE(best.finished);
  EXPECT_EQ(best.start.form, 0);
  EXPECT_NEAR(best.end.mean_square / end.mean_square, 1, 1e-6);
  for (const BasinEnd& other : basins.ends()) EXPECT_GE(other.paid, best.paid);
}

TEST_F(BasinsTest, WhatAFormFreesIsPaidFor) {
  Basins basins(job_.problem, job_.forms, &job_.watch);
  basins.Descend(ShapeStarts(job_));
  const double points = static_cast<double>(made_.curve.size());
  for (const BasinEnd& end : basins.ends()) {
    const double free = job_.forms[end.start.form].free;
    EXPECT_NEAR(points * std::log(end.paid / end.end.mean_square), free * std::log(points), 1e-6);
  }
}

TEST_F(BasinsTest, CountsWhatWasMet) {
  Basins basins(job_.problem, job_.forms, &job_.watch);
  const double d1 = made_.truth.at("substrings.d1");
  const double d2 = made_.truth.at("substrings.d2");
  const double d3 = made_.truth.at("substrings.d3");
  // Equal groups may change places: the same basin twice.
  basins.Descend({Changed(d1, d2, d3), Changed(d3, d1, d2)});
  BasinCount count = basins.Count();
  EXPECT_EQ(count.starts, 2);
  EXPECT_EQ(count.basins, 1);
  EXPECT_EQ(count.best_visits, 2);
  EXPECT_EQ(count.once, 0);
  EXPECT_EQ(count.twice, 1);
  EXPECT_EQ(count.unseen, 0);
  EXPECT_EQ(basins.visits(), 2);
  // Far away: given up, and in no count.
  basins.Descend({Changed(0.02, 0.02, 0.02)});
  ASSERT_EQ(basins.ends().size(), 3u);
  count = basins.Count();
  EXPECT_EQ(count.starts, basins.ends()[2].finished ? 3 : 2);
}

TEST_F(BasinsTest, EstimatesTheUnseenAsChaoDoes) {
  Basins basins(job_.problem, job_.forms, &job_.watch);
  basins.Descend(ShapeStarts(job_));
  for (const BasinEnd& end : basins.ends()) EXPECT_TRUE(std::isfinite(end.paid));
  const BasinCount count = basins.Count();
  // Ends in order, a new basin where they are apart.
  std::vector<double> paid;
  for (const BasinEnd& end : basins.ends()) {
    if (end.finished) paid.push_back(end.paid);
  }
  std::sort(paid.begin(), paid.end());
  std::vector<int> visits;
  for (std::size_t k = 0; k < paid.size(); ++k) {
    if (k == 0 || paid[k] > paid[k - 1] * (1 + 1e-6)) visits.push_back(0);
    ++visits.back();
  }
  const int once = static_cast<int>(std::count(visits.begin(), visits.end(), 1));
  const int twice = static_cast<int>(std::count(visits.begin(), visits.end(), 2));
  EXPECT_EQ(count.starts, static_cast<int>(paid.size()));
  EXPECT_EQ(count.basins, static_cast<int>(visits.size()));
  EXPECT_EQ(count.best_visits, visits.front());
  EXPECT_EQ(count.once, once);
  EXPECT_EQ(count.twice, twice);
  EXPECT_DOUBLE_EQ(count.unseen, once * (once - 1) / (2.0 * (twice + 1)));
}

}  // namespace
}  // namespace lyrefit
