#include "lyrefit/fit/search_candidates.h"
#include "lyrefit/fit/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/simulated.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/effects/catalogue.h"
#include "lyrefit/fit/simulate.h"
#include "repeats.h"

namespace lyrefit {
namespace {

constexpr double kCertified_A = 9.860218778918e-4;  // data/rtc_france/expected.json

// A prepared fit for search candidates.
struct Nest {
  Nest(const IvCurve& curve, FitOptions how)
      : options(std::move(how)), job{curve, options, none,
                                     {},    {},      0,
                                     {},    {},      ProgressReporter(none, 0),
                                     {}} {
    const auto ready = PrepareFit(&job, &report);
    EXPECT_TRUE(ready) << ready.error().ToString();
  }
  FitOptions options;
  Observer none;
  FitReport report;
  FitJob job;
};

FitOptions Hard(Model model, Objective objective) {
  FitOptions options;
  options.model = model;
  options.objective = objective;
  options.candidates = SearchVariables::kHard;
  options.intervals = Intervals::kNone;
  options.threads = 1;
  return options;
}

IvCurve RtcFrance() { return ReadCurve(std::string(LYREFIT_DATA_DIR) + "/rtc_france").value(); }

std::vector<double> RandomPoint(const Box& box, RandomStream* random) {
  std::vector<double> x;
  for (std::size_t j = 0; j < box.lower.size(); ++j) {
    x.push_back(box.lower[j] + random->Uniform() * (box.upper[j] - box.lower[j]));
  }
  return x;
}

// Three substrings under different lights. With `truth` the depths are fixed at their true values;
// otherwise they are free.
std::vector<EffectUse> Substrings(bool truth) {
  const std::pair<double, double> third = {1.0 / 3, 1.0 / 3};
  EffectUse use{FindEffect("substrings"), {{"w1", third}, {"w2", third}}};
  use.ranges["d1"] = truth ? std::pair{0.5, 0.5} : std::pair{0.0, 0.999};
  use.ranges["d2"] = truth ? std::pair{0.25, 0.25} : std::pair{0.0, 0.999};
  return {use};
}

IvCurve String() {
  SimulateOptions options;
  options.parameters = {{"Iph", 8.2}, {"Is1", 2e-9}, {"n", 1.15}, {"Rs", 0.25}, {"Rsh", 300}};
  options.conditions.cells_in_series = 60;
  options.noise_A = 0.004;
  options.seed = 3;
  options.with = Substrings(true);
  const auto curve = Simulate(options);
  EXPECT_TRUE(curve) << curve.error().ToString();
  return *curve;
}

TEST(HardCandidates, HaveTheCertifiedOptimumWhereItsRsAndNAre) {
  const IvCurve curve = RtcFrance();
  const Nest nest(curve, Hard(Model::kSingleDiode, Objective::kMeasuredCurrent));
  FitOptions full = nest.options;
  full.candidates = SearchVariables::kAll;
  const auto report = Fit(curve, full);
  ASSERT_TRUE(report);
  SearchCandidates places(nest.job, nest.job.problem);
  ASSERT_EQ(places.box().lower.size(), 2U);  // n and Rs
  const std::vector<double> x = {report->refined[IdealityIndex(0)], report->refined[kRs]};
  ASSERT_EQ(places.DeviceAt(x.data())[kRs], x[1]);
  EXPECT_NEAR(places.RmseAt(x.data()) / kCertified_A, 1, 1e-9);
}

// RMSE of a random candidate of the hard parameters, and the smallest RMSE of many complete
// candidates with equal hard parameters.
struct Pair {
  double hard = 0;
  double complete = HUGE_VAL;
};

std::vector<Pair> RandomPairs(const IvCurve& curve, const FitOptions& options) {
  const Nest nest(curve, options);
  SearchCandidates hard(nest.job, nest.job.problem);
  const SearchSpace space = CompleteSpace(nest.job);
  RandomStream random(7, 0);
  std::vector<Pair> pairs;
  for (int place = 0; place < 20; ++place) {
    const std::vector<double> at = RandomPoint(hard.box(), &random);
    const std::vector<double> solved = hard.DeviceAt(at.data());
    const std::vector<double> here = space.FromParameters(solved.data(), 0);
    Pair pair{hard.RmseAt(at.data())};
    for (int draw = 0; draw < 300; ++draw) {  // every second one near the solution
      std::vector<double> x = RandomPoint(space.box(), &random);
      for (std::size_t j = 0; j < x.size() && draw % 2 == 1; ++j) {
        x[j] = here[j] + 1e-3 * (x[j] - here[j]);
      }
      std::vector<double> p(solved.size()), drawn(solved.size());
      space.ToParameters(x.data(), drawn.data());
      p = solved;
      p[kIph] = drawn[kIph];
      p[kRsh] = drawn[kRsh];
      for (int d = 0; d < DiodeCount(nest.report.device); ++d) {
        p[SaturationCurrentIndex(d)] = drawn[SaturationCurrentIndex(d)];
      }
      const double mean_square = MeanSquare(nest.job.problem, p);
      if (mean_square < pair.complete * pair.complete) pair.complete = std::sqrt(mean_square);
    }
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(HardCandidates, AreNoWorseThanAnyCompleteCandidateOfTheSameRsAndN) {
  for (const Model model : {Model::kSingleDiode, Model::kDoubleDiode, Model::kTripleDiode}) {
    for (const Pair& pair : RandomPairs(RtcFrance(), Hard(model, Objective::kMeasuredCurrent))) {
      EXPECT_LE(pair.hard, pair.complete * (1 + 1e-12));
    }
    // A diode without use to the fit is removed step by step, so that a remainder of it may be
    // left.
    for (const Pair& pair : RandomPairs(RtcFrance(), Hard(model, Objective::kSolvedCurrent))) {
      EXPECT_LE(pair.hard, pair.complete * 1.005);
    }
  }
}

// A lower local optimum may be missed, but only where the candidate is far from any fit.
TEST(HardCandidates, AreNoWorseThanAnyCompleteCandidateOfTheSameEffectsThatCouldWin) {
  SKIP_IF_SANITIZED();
  FitOptions options = Hard(Model::kSingleDiode, Objective::kSolvedCurrent);
  options.with = Substrings(false);
  int better = 0;
  for (const Pair& pair : RandomPairs(String(), options)) {
    if (pair.hard <= pair.complete * (1 + 1e-5)) continue;
    ++better;
    EXPECT_GT(pair.complete, 100 * 0.004);
  }
  EXPECT_LE(better, 4);
}

TEST(HardCandidates, ComeToTheNoiseWhereTheEffectsAreTrue) {
  SKIP_IF_SANITIZED();
  const IvCurve curve = String();
  FitOptions options = Hard(Model::kSingleDiode, Objective::kSolvedCurrent);
  options.with = Substrings(false);
  const Nest nest(curve, options);
  SearchCandidates places(nest.job, nest.job.problem);
  ASSERT_EQ(places.box().lower.size(), 5U);  // n, Rs, two depths, Vb
  const auto best = Fit(curve, options);
  ASSERT_TRUE(best);
  EXPECT_LT(best->rmse.searched.solved_current_A, 0.2);
  const std::vector<double> truth = {1.15, 0.25, 0.5, 0.25, nest.job.variants[0].usual[8]};
  EXPECT_NEAR(places.RmseAt(truth.data()) / 0.004, 1, 0.15);
  EXPECT_NEAR(places.RmseAt(truth.data()) / best->rmse.refined.solved_current_A, 1, 0.03);
}

TEST(HardCandidates, CountWhatTheyCostTheCurve) {
  for (const Objective objective : {Objective::kMeasuredCurrent, Objective::kSolvedCurrent}) {
    FitOptions options = Hard(Model::kDoubleDiode, objective);
    const auto hard = Fit(RtcFrance(), options), again = Fit(RtcFrance(), options);
    options.candidates = SearchVariables::kAll;
    const auto all = Fit(RtcFrance(), options);
    ASSERT_TRUE(hard && again && all);
    EXPECT_EQ(all->curve_evaluations, all->search.evaluations);
    EXPECT_GE(hard->curve_evaluations, 2 * hard->search.evaluations);
    EXPECT_EQ(hard->curve_evaluations, again->curve_evaluations);
    EXPECT_EQ(hard->search.best.x, again->search.best.x);
    EXPECT_EQ(hard->searched, again->searched);
    EXPECT_EQ(hard->refined, again->refined);
    EXPECT_LT(hard->rmse.searched.Of(objective), 0.1 * all->rmse.searched.Of(objective));
    EXPECT_NEAR(hard->rmse.refined.Of(objective) / all->rmse.refined.Of(objective), 1, 1e-9);
    EXPECT_NEAR(hard->search.best.objective / hard->rmse.searched.Of(objective), 1, 1e-9);
  }
}

TEST(HardCandidates, KeepWhatIsFixed) {
  FitOptions options = Hard(Model::kDoubleDiode, Objective::kSolvedCurrent);
  options.fixed = {{"n2", 2}, {"Rsh", 60}};
  const auto report = Fit(RtcFrance(), options);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->searched[kRsh], 60);
  EXPECT_EQ(report->refined[kRsh], 60);
  EXPECT_EQ(report->searched[IdealityIndex(1)], 2);
  options.fixed = {{"n1", 1.2}, {"n2", 2}, {"Rs", 0.03}};
  const auto none = Fit(RtcFrance(), options);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message,
            "candidates hard leaves nothing to search: Rs and every n are fixed");
}

TEST(HardCandidates, OfManyPointsAreSolvedOnAllOfThem) {
  const IvCurve curve = ModuleCurve(Model::kSingleDiode, kSingleTruth, 1e-3, 1, 3000);
  const auto report = Fit(curve, Hard(Model::kSingleDiode, Objective::kSolvedCurrent));
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->search.best.objective / report->rmse.searched.solved_current_A, 1, 1e-9);
}

TEST(Knees, StandInTheBoxOfTheSearchThatAsksForThem) {
  const IvCurve curve = String();
  FitOptions options = Hard(Model::kSingleDiode, Objective::kSolvedCurrent);
  options.candidates = SearchVariables::kAll;
  options.with = Substrings(false);
  const auto plain = Fit(curve, options);
  options.search.algorithm = Algorithm::kMloKnees;
  const auto knees = Fit(curve, options);
  ASSERT_TRUE(plain && knees);
  // A suggested place is evaluated once more, for its rank.
  EXPECT_GT(knees->curve_evaluations, knees->search.evaluations);
  EXPECT_LE(knees->search.trace[0].best, plain->search.trace[0].best);
  const Nest nest(curve, options);
  SearchCandidates places(nest.job, nest.job.problem);
  places.Suggest({{"one", plain->refined, 0}});
  ASSERT_EQ(places.box().suggested.size(), 1U);
  EXPECT_NEAR(
      places.RmseAt(places.box().suggested[0].data()) / plain->rmse.refined.solved_current_A, 1,
      1e-9);
}

}  // namespace
}  // namespace lyrefit
