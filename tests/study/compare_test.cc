#include "lyrefit/study/compare.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/settings/bounds_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

#include "lyrefit/search/search.h"
#include "lyrefit/study/report/documents.h"
#include "small_study.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Bitwise equality, also of NaN.
bool Same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void ExpectSameRuns(const Comparison& a, const Comparison& b) {
  ASSERT_EQ(a.problems.size(), b.problems.size());
  for (std::size_t p = 0; p < a.problems.size(); ++p) {
    EXPECT_TRUE(Same(a.problems[p].reference.rmse_A, b.problems[p].reference.rmse_A));
    for (std::size_t c = 0; c < a.problems[p].algorithms.size(); ++c) {
      const AlgorithmResult& x = a.problems[p].algorithms[c];
      const AlgorithmResult& y = b.problems[p].algorithms[c];
      EXPECT_TRUE(Same(x.expected_evaluations, y.expected_evaluations));
      ASSERT_EQ(x.runs.size(), y.runs.size());
      for (std::size_t r = 0; r < x.runs.size(); ++r) {
        EXPECT_TRUE(Same(x.runs[r].searched_A, y.runs[r].searched_A));
        EXPECT_TRUE(Same(x.runs[r].plain_polished_A, y.runs[r].plain_polished_A));
        EXPECT_TRUE(Same(x.runs[r].own_polished_A, y.runs[r].own_polished_A));
        EXPECT_TRUE(Same(x.runs[r].polished_A, y.runs[r].polished_A));
        EXPECT_EQ(x.runs[r].evaluations, y.runs[r].evaluations);
        EXPECT_EQ(x.runs[r].evaluations_to_target, y.runs[r].evaluations_to_target);
      }
      ASSERT_EQ(x.trace.size(), y.trace.size());
      for (std::size_t t = 0; t < x.trace.size(); ++t) {
        EXPECT_EQ(x.trace[t].evaluations, y.trace[t].evaluations);
        EXPECT_TRUE(Same(x.trace[t].best_A, y.trace[t].best_A));
      }
    }
  }
}

Comparison Compared(const std::vector<ComparedAlgorithm>& algorithms, const CompareOptions& options,
                    const Observer& observer = {}) {
  auto comparison = Compare({RtcFrance()}, algorithms, options, observer);
  EXPECT_TRUE(comparison) << comparison.error().ToString();
  return *comparison;
}

TEST(Compare, GivesTheSameBitsOnAnyNumberOfThreads) {
  CompareOptions options = SmallOptions();
  options.plain_polish = true;
  options.threads = 1;
  const Comparison one = Compared(SmallAlgorithms(), options);
  options.threads = 3;
  ExpectSameRuns(one, Compared(SmallAlgorithms(), options));
}

TEST(Compare, RunsEachAlgorithmAsAFitOfItsOwnWould) {
  const CompareOptions options = SmallOptions();
  const Comparison comparison = Compared(SmallAlgorithms(), options);
  FitOptions fit;
  fit.model = Model::kDoubleDiode;
  fit.objective = options.objective;
  fit.search = SmallSearch();
  fit.search.algorithm = Algorithm::kDe;
  fit.search.seed = options.seed;
  fit.search.run = 2;
  fit.intervals = Intervals::kNone;
  const auto report = Fit(RtcFrance().curve, fit);
  ASSERT_TRUE(report);
  const RunRecord& run = comparison.problems[1].algorithms[1].runs[2];
  EXPECT_EQ(run.searched_A, report->rmse.searched.measured_current_A);
  EXPECT_EQ(run.own_polished_A, report->rmse.refined_best_candidate.measured_current_A);
  EXPECT_EQ(run.polished_A, report->rmse.refined.measured_current_A);
  EXPECT_TRUE(std::isnan(run.plain_polished_A));
}

TEST(Compare, GivesAllAlgorithmsTheSameBudget) {
  const Comparison comparison = Compared(SmallAlgorithms(), SmallOptions());
  for (const AlgorithmResult& compared : comparison.problems[0].algorithms) {
    for (const RunRecord& run : compared.runs) {
      EXPECT_LE(run.evaluations, 210) << compared.name;
      // The best candidate of MLO has no better one to move to, so that half of its moves take no
      // evaluation.
      EXPECT_GE(run.evaluations, compared.name == "mlo" ? 185 : 210) << compared.name;
    }
  }
}

TEST(Compare, StartsAllAlgorithmsOfARunFromTheSamePoints) {
  const Comparison comparison = Compared(SmallAlgorithms(), SmallOptions());
  const auto& algorithms = comparison.problems[0].algorithms;
  for (const AlgorithmResult& compared : algorithms) {
    EXPECT_EQ(compared.trace.front().evaluations, 10);
    EXPECT_EQ(compared.trace.front().best_A, algorithms[0].trace.front().best_A);
  }
}

TEST(Compare, OrdersProblemsByCurveThenModel) {
  CompareOptions options = SmallOptions();
  options.runs = 1;
  options.polish = false;
  const auto comparison = Compare({RtcFrance(), RtcFrance("wide")}, SmallAlgorithms(), options);
  ASSERT_TRUE(comparison);
  std::vector<std::string> order;
  for (const ProblemResult& problem : comparison->problems) {
    order.push_back(problem.bounds_name + " " + ToText(problem.model));
    EXPECT_EQ(problem.curve_name, "rtc_france");
  }
  EXPECT_THAT(order, ElementsAre("physical sd", "physical dd", "wide sd", "wide dd"));
}

TEST(Compare, MeasuresAgainstTheCertifiedOptimumOrTheBestOfAllRuns) {
  const Comparison comparison = Compared(SmallAlgorithms(), SmallOptions());
  for (const ProblemResult& problem : comparison.problems) {
    double best = kInfinity;
    for (const AlgorithmResult& compared : problem.algorithms) {
      for (const RunRecord& run : compared.runs) best = std::min(best, run.polished_A);
    }
    EXPECT_NEAR(problem.reference.rmse_A / best, 1, 1e-9);
    EXPECT_LE(problem.reference.rmse_A, best);
    EXPECT_TRUE(problem.reference.certified);
  }
  EXPECT_NEAR(comparison.problems[0].reference.rmse_A, 9.860218779e-4, 1e-13);
  EXPECT_EQ(comparison.problems[0].reference.parameters.size(), 5U);
}

TEST(Compare, LeavesOutWhatIsNotAskedFor) {
  CompareOptions options = SmallOptions();
  options.polish = false;
  const Comparison pure = Compared(SmallAlgorithms(), options);
  const ProblemResult& problem = pure.problems[0];
  EXPECT_TRUE(std::isnan(problem.algorithms[0].polished.min));
  EXPECT_TRUE(std::isnan(problem.algorithms[0].plain_polished.mean));
  EXPECT_FALSE(problem.searched.pairs.empty());
  EXPECT_TRUE(problem.polished.pairs.empty());
  options.rankings = false;
  EXPECT_TRUE(Compared(SmallAlgorithms(), options).problems[0].searched.pairs.empty());
}

TEST(Compare, RanksNothingForOneAlgorithmOrOneRun) {
  CompareOptions options = SmallOptions();
  const Comparison alone = Compared({SmallAlgorithms()[0]}, options);
  EXPECT_TRUE(alone.problems[0].searched.pairs.empty());
  EXPECT_EQ(alone.problems[0].polished.friedman.algorithms, 0);
  options.runs = 1;
  const Comparison once = Compared(SmallAlgorithms(), options);
  EXPECT_TRUE(once.problems[0].searched.signed_ranks.empty());
}

TEST(Compare, TakesASearchOfTheUsersOwn) {
  ComparedAlgorithm own{"middle", {}, SmallSearch(), {}};
  own.searcher = [](const ObjectiveFunction& objective, const Box& box, const SearchOptions&,
                    const Observer&) {
    SearchSummary summary;
    for (std::size_t j = 0; j < box.lower.size(); ++j) {
      summary.best.x.push_back(0.5 * (box.lower[j] + box.upper[j]));
    }
    summary.best.objective = objective(summary.best.x.data());
    summary.elites = {summary.best};
    summary.evaluations = 1;
    return summary;  // without a trace
  };
  const Comparison comparison = Compared({own, SmallAlgorithms()[0]}, SmallOptions());
  const AlgorithmResult& result = comparison.problems[0].algorithms[0];
  EXPECT_EQ(result.algorithm, "middle");
  EXPECT_EQ(result.runs[0].evaluations, 1);
  EXPECT_EQ(result.searched.std, 0);
  ASSERT_EQ(result.trace.size(), 1U);
  EXPECT_EQ(result.trace[0].best_A, result.searched.min);
}

TEST(Compare, SaysWhichSearchSpentMoreThanItsBudget) {
  ComparedAlgorithm own{"spender", {}, SmallSearch(), {}};
  own.searcher = [](const ObjectiveFunction& objective, const Box& box,
                    const SearchOptions& options, const Observer& observer) {
    SearchOptions longer = options;
    longer.algorithm = Algorithm::kRandom;               // spends all
    longer.iterations += static_cast<int>(options.run);  // the first run keeps to it
    return Search(objective, box, longer, observer);
  };
  const CompareOptions options = SmallOptions();
  const Comparison comparison = Compared({SmallAlgorithms()[0], own}, options);
  const std::string sentence = "spender spent up to 240 evaluations in a run, its budget is 210";
  EXPECT_THAT(comparison.over_budget, ElementsAre(sentence));
  EXPECT_THAT(CompareText(comparison), HasSubstr("UNEQUAL BUDGETS: " + sentence));
  EXPECT_THAT(CompareJson(comparison), HasSubstr(sentence));
  EXPECT_THAT(Compared(SmallAlgorithms(), options).over_budget, ElementsAre());
}

TEST(Compare, SaysWhichParametersAreSearchedAsLogarithms) {
  CompareOptions options = SmallOptions();
  options.models = {Model::kSingleDiode};
  const Comparison physical = Compared(SmallAlgorithms(), options);
  EXPECT_THAT(physical.problems[0].log_searched,
              ElementsAre("saturation_current", "resistance_shunt"));
  EXPECT_THAT(CompareText(physical), HasSubstr("ln(saturation_current), ln(resistance_shunt)"));
  const std::string folder = std::string(LYREFIT_DATA_DIR) + "/rtc_france";
  CompareCurve published = RtcFrance();
  published.bounds = *NamedBounds("literature", folder);
  const auto linear = Compare({published}, SmallAlgorithms(), options);
  ASSERT_TRUE(linear);
  EXPECT_THAT(linear->problems[0].log_searched, ElementsAre());
}

TEST(Compare, RefusesTheFirstRunOfASearchThatLeavesTheBoundsOnAnyNumberOfThreads) {
  ComparedAlgorithm own{"outside", {}, SmallSearch(), {}};
  own.searcher = [](const ObjectiveFunction& objective, const Box& box,
                    const SearchOptions& options, const Observer&) {
    SearchSummary summary;
    summary.best.x = box.upper;
    summary.best.objective = objective(summary.best.x.data());
    summary.best.x[0] += static_cast<double>(options.run);  // the first run stays within
    summary.elites = {summary.best};
    return summary;
  };
  CompareOptions options = SmallOptions();
  options.runs = 20;
  std::string first;
  for (const int threads : {1, 4}) {
    options.threads = threads;
    const auto refused = Compare({RtcFrance()}, {own}, options);
    ASSERT_FALSE(refused);
    if (first.empty()) first = refused.error().message;
    EXPECT_EQ(refused.error().message, first);
  }
  EXPECT_THAT(first, HasSubstr("outside cannot be compared on rtc_france"));
  EXPECT_THAT(first, HasSubstr("expected a number in"));
}

TEST(Compare, TellsTheObserverOfEveryRunOneThreadAtATime) {
  std::atomic<int> inside{0};
  std::vector<std::int64_t> done;
  std::int64_t evaluations = 0;
  const Observer observer = [&](const Progress& progress) {
    EXPECT_EQ(++inside, 1);
    EXPECT_EQ(progress.stage, "compare");
    EXPECT_EQ(progress.iterations, 24);
    EXPECT_GE(progress.evaluations, evaluations);
    evaluations = progress.evaluations;
    if (done.empty() || progress.iteration != done.back()) done.push_back(progress.iteration);
    --inside;
    return ObserverAction::kContinue;
  };
  Compared(SmallAlgorithms(), SmallOptions(), observer);
  std::vector<std::int64_t> all(25);
  for (int i = 0; i < 25; ++i) all[i] = i;
  EXPECT_EQ(done, all);
}

Observer StopAfter(std::int64_t runs) {
  return [runs](const Progress& progress) {
    return progress.iteration >= runs ? ObserverAction::kStop : ObserverAction::kContinue;
  };
}

TEST(Compare, KeepsEveryFinishedRunWhenStopped) {
  CompareOptions options = SmallOptions();
  const Comparison whole = Compared(SmallAlgorithms(), options);
  options.threads = 1;  // two threads could have passed the run that stops
  const Comparison part = Compared(SmallAlgorithms(), options, StopAfter(12 + 8));
  EXPECT_TRUE(part.interrupted);
  ASSERT_EQ(part.problems.size(), 2U);
  EXPECT_TRUE(part.problems[0].complete);
  EXPECT_EQ(part.problems[0].algorithms[2].runs[3].polished_A,
            whole.problems[0].algorithms[2].runs[3].polished_A);
  const ProblemResult& cut = part.problems[1];
  EXPECT_FALSE(cut.complete);
  EXPECT_FALSE(cut.reference.certified) << "the proof was not begun";
  ASSERT_EQ(cut.algorithms.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<RunRecord>& runs = cut.algorithms[c].runs;
    ASSERT_EQ(runs.size(), c < 2 ? 3U : 2U) << "run by run, compared by compared";
    for (const RunRecord& run : runs) {
      EXPECT_EQ(run.polished_A, whole.problems[1].algorithms[c].runs[run.run].polished_A);
    }
  }
  EXPECT_EQ(cut.searched.friedman.blocks, 2) << "what all have done";
  const Comparison none = Compared(SmallAlgorithms(), options, StopAfter(0));
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(none.problems.empty());
  EXPECT_FALSE(whole.interrupted);
}

TEST(Compare, LeavesOutAlgorithmsWithoutARun) {
  CompareOptions options = SmallOptions();
  options.threads = 1;
  const Comparison part = Compared(SmallAlgorithms(), options, StopAfter(2));
  ASSERT_EQ(part.problems.size(), 1U);
  ASSERT_EQ(part.problems[0].algorithms.size(), 2U);
  EXPECT_EQ(part.problems[0].algorithms[1].name, "de");
  EXPECT_TRUE(part.problems[0].searched.pairs.empty());
}

TEST(Compare, StopsInsideALongRun) {
  std::vector<ComparedAlgorithm> algorithms = {SmallAlgorithms()[0]};
  algorithms[0].search.iterations = 100000000;
  CompareOptions options = SmallOptions();
  int calls = 0;
  const Observer observer = [&](const Progress&) {
    return ++calls > 1 ? ObserverAction::kStop : ObserverAction::kContinue;
  };
  const Comparison stopped = Compared(algorithms, options, observer);
  EXPECT_TRUE(stopped.interrupted);
  EXPECT_TRUE(stopped.problems.empty()) << "none is done";
}

// The error of a comparison that is refused. No run may have started before.
std::string Refusal(const std::vector<CompareCurve>& curves,
                    const std::vector<ComparedAlgorithm>& algorithms,
                    const CompareOptions& options) {
  bool ran = false;
  const Observer observer = [&](const Progress&) {
    ran = true;
    return ObserverAction::kContinue;
  };
  const auto comparison = Compare(curves, algorithms, options, observer);
  EXPECT_FALSE(ran);
  return comparison ? "not refused" : comparison.error().message;
}

TEST(Compare, RefusesBadAlgorithms) {
  const CompareOptions options = SmallOptions();
  EXPECT_THAT(Refusal({RtcFrance()}, {}, options), HasSubstr("no algorithm"));
  std::vector<ComparedAlgorithm> twice = SmallAlgorithms();
  twice[2].name = "mlo";
  EXPECT_EQ(Refusal({RtcFrance()}, twice, options), "the algorithm mlo is named twice");
  std::vector<ComparedAlgorithm> nameless = SmallAlgorithms();
  nameless[1].name = "";
  EXPECT_EQ(Refusal({RtcFrance()}, nameless, options), "an algorithm has no name");
  std::vector<ComparedAlgorithm> tiny = SmallAlgorithms();
  tiny[1].search.population = 2;
  EXPECT_EQ(Refusal({RtcFrance()}, tiny, options), "de: population = 2 is outside [4, 20000]");
}

TEST(Compare, RefusesBadOptions) {
  const auto refusal = [](const auto& change) {
    CompareOptions options = SmallOptions();
    change(&options);
    return Refusal({RtcFrance()}, SmallAlgorithms(), options);
  };
  EXPECT_THAT(refusal([](CompareOptions* o) { o->runs = 0; }), HasSubstr("runs = 0 is outside"));
  EXPECT_THAT(refusal([](CompareOptions* o) { o->models.clear(); }), HasSubstr("no model"));
  EXPECT_THAT(refusal([](CompareOptions* o) { o->models[1] = o->models[0]; }),
              HasSubstr("the model sd is named twice"));
  EXPECT_THAT(refusal([](CompareOptions* o) { o->target_gap = 0; }), HasSubstr("target-gap"));
  EXPECT_THAT(refusal([](CompareOptions* o) { o->target_gap = kUnknown; }),
              HasSubstr("target-gap"));
  EXPECT_THAT(refusal([](CompareOptions* o) { o->threads = -3; }), HasSubstr("threads = -3"));
  EXPECT_THAT(Refusal({}, SmallAlgorithms(), SmallOptions()), HasSubstr("no curve"));
}

TEST(Compare, FindsTheMistakeInTheLastProblemBeforeTheFirstRun) {
  CompareCurve reversed = RtcFrance();
  reversed.bounds.overrides["n"] = {2, 1};
  EXPECT_THAT(Refusal({RtcFrance(), reversed}, SmallAlgorithms(), SmallOptions()),
              HasSubstr("sd cannot be compared on rtc_france: "));
  CompareCurve few = RtcFrance();  // enough for five parameters, too few for seven
  few.curve.voltage_V.resize(6);
  few.curve.current_A.resize(6);
  EXPECT_THAT(Refusal({RtcFrance(), few}, SmallAlgorithms(), SmallOptions()),
              HasSubstr("dd cannot be compared on rtc_france: 6 points"));
}

}  // namespace
}  // namespace lyrefit
