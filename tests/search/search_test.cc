#include "lyrefit/search/search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lyrefit {
namespace {

const Box kBox = {{-2, -2, -2}, {3, 3, 3}};

double Sphere(const double* x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; }

std::vector<Algorithm> AllAlgorithms() {
  std::vector<Algorithm> all;
  for (const auto& row : EnumTable<Algorithm>::kRows) all.push_back(row.value);
  return all;
}

void ExpectSame(const SearchSummary& a, const SearchSummary& b) {
  EXPECT_EQ(a.best.x, b.best.x);
  EXPECT_EQ(a.best.objective, b.best.objective);
  EXPECT_EQ(a.evaluations, b.evaluations);
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t k = 0; k < a.trace.size(); ++k) EXPECT_EQ(a.trace[k].best, b.trace[k].best);
}

class EveryAlgorithm : public ::testing::TestWithParam<Algorithm> {
 protected:
  SearchOptions Options() const {
    SearchOptions options;
    options.algorithm = GetParam();
    return options;
  }
};

TEST_P(EveryAlgorithm, StartsFromTheFirstPopulation) {
  SearchOptions options = Options();
  options.seed = 5;
  options.run = 2;
  std::vector<std::vector<double>> asked;
  const ObjectiveFunction objective = [&asked](const double* x) {
    asked.emplace_back(x, x + 3);
    return Sphere(x);
  };
  Search(objective, kBox, options);
  asked.resize(options.population);
  EXPECT_EQ(asked, FirstPopulation(kBox, options));
}

TEST_P(EveryAlgorithm, GivesTheSameBitsForTheSameSeedAndOthersForAnother) {
  SearchOptions options = Options();
  options.seed = 5;
  const SearchSummary first = Search(Sphere, kBox, options);
  ExpectSame(first, Search(Sphere, kBox, options));
  options.seed = 6;
  EXPECT_NE(Search(Sphere, kBox, options).best.x, first.best.x);
  options.seed = 5;
  options.run = 1;
  EXPECT_NE(Search(Sphere, kBox, options).best.x, first.best.x);
}

TEST_P(EveryAlgorithm, NeverLeavesTheBoxAndCountsEveryEvaluation) {
  std::int64_t calls = 0;
  const SearchSummary summary = Search(
      [&](const double* x) {
        ++calls;
        for (int j = 0; j < 3; ++j) {
          EXPECT_GE(x[j], kBox.lower[j]);
          EXPECT_LE(x[j], kBox.upper[j]);
        }
        return Sphere(x);
      },
      kBox, Options());
  EXPECT_EQ(summary.evaluations, calls);
  EXPECT_LE(calls, 20 * 21);
  EXPECT_EQ(summary.termination, SearchTermination::kIterations);
  EXPECT_EQ(summary.iterations, 20);
}

TEST_P(EveryAlgorithm, HasATraceThatOnlyFalls) {
  const SearchSummary summary = Search(Sphere, kBox, Options());
  ASSERT_EQ(summary.trace.size(), 21U);
  for (std::size_t k = 1; k < summary.trace.size(); ++k) {
    EXPECT_LE(summary.trace[k].best, summary.trace[k - 1].best);
  }
  EXPECT_EQ(summary.trace.back().best, summary.best.objective);
  EXPECT_EQ(Sphere(summary.best.x.data()), summary.best.objective);
}

TEST_P(EveryAlgorithm, StopsForEachReasonAndSaysWhich) {
  SearchOptions options = Options();
  options.max_evaluations = 100;
  SearchSummary summary = Search(Sphere, kBox, options);
  EXPECT_EQ(summary.termination, SearchTermination::kEvaluations);
  EXPECT_EQ(summary.evaluations, 100);

  options = Options();
  options.target = 3;
  options.iterations = 1000;
  summary = Search(Sphere, kBox, options);
  EXPECT_EQ(summary.termination, SearchTermination::kTarget);
  EXPECT_LE(summary.best.objective, 3);

  options = Options();
  options.iterations = 100000000;
  options.time_limit_s = 0.02;
  EXPECT_EQ(Search(Sphere, kBox, options).termination, SearchTermination::kTimeLimit);

  options = Options();
  options.iterations = 1000000;
  options.patience = 7;
  summary = Search([](const double*) { return 1.0; }, kBox, options);
  EXPECT_EQ(summary.termination, SearchTermination::kPatience);
  EXPECT_EQ(summary.iterations, 7);

  options = Options();
  summary = Search(Sphere, kBox, options, [](const Progress& progress) {
    return progress.iteration == 3 ? ObserverAction::kStop : ObserverAction::kContinue;
  });
  EXPECT_EQ(summary.termination, SearchTermination::kInterrupted);
  EXPECT_EQ(summary.iterations, 3);

  // The observer of a large population is asked within iterations, too.
  options.population = 5000;
  summary = Search(Sphere, kBox, options, [](const Progress& progress) {
    return progress.evaluations >= 6500 ? ObserverAction::kStop : ObserverAction::kContinue;
  });
  EXPECT_EQ(summary.termination, SearchTermination::kInterrupted);
  EXPECT_LT(summary.evaluations, 8000);
}

TEST_P(EveryAlgorithm, SurvivesAnObjectiveOfNothingButNaN) {
  const SearchSummary summary = Search([](const double*) { return std::nan(""); }, kBox, Options());
  EXPECT_EQ(summary.best.objective, kInfinity);
  EXPECT_EQ(summary.best.x.size(), 3U);
}

TEST_P(EveryAlgorithm, ReturnsDistinctElitesBestFirst) {
  SearchOptions options = Options();
  options.elites = 5;
  options.iterations = 3;
  const SearchSummary summary = Search(Sphere, kBox, options);
  ASSERT_EQ(summary.elites.size(), 5U);
  EXPECT_EQ(summary.elites[0].x, summary.best.x);
  for (std::size_t a = 1; a < summary.elites.size(); ++a) {
    EXPECT_GE(summary.elites[a].objective, summary.elites[a - 1].objective);
    for (std::size_t b = 0; b < a; ++b) {
      double apart = 0;
      for (int j = 0; j < 3; ++j) {
        apart = std::max(apart, std::fabs(summary.elites[a].x[j] - summary.elites[b].x[j]) / 5);
      }
      EXPECT_GT(apart, 0.01);
    }
  }
}

TEST_P(EveryAlgorithm, ThinsALongTraceAndKeepsItsEnds) {
  SearchOptions options = Options();
  options.population = 4;
  options.iterations = 150001;
  const SearchSummary summary = Search(Sphere, kBox, options);
  EXPECT_LE(summary.trace.size(), 65538U);
  EXPECT_GE(summary.trace.size(), 32768U);
  EXPECT_EQ(summary.trace.front().iteration, 0);
  EXPECT_EQ(summary.trace.back().iteration, 150001);
  EXPECT_EQ(summary.trace.back().evaluations, summary.evaluations);
  EXPECT_EQ(summary.trace.back().best, summary.best.objective);
  for (std::size_t k = 1; k < summary.trace.size(); ++k) {
    ASSERT_GT(summary.trace[k].iteration, summary.trace[k - 1].iteration);
    ASSERT_LE(summary.trace[k].best, summary.trace[k - 1].best);
  }
}

std::string AlgorithmName(const ::testing::TestParamInfo<Algorithm>& info) {
  std::string name = ToText(info.param);
  std::replace(name.begin(), name.end(), '+', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, EveryAlgorithm, ::testing::ValuesIn(AllAlgorithms()), AlgorithmName);

TEST(Lyrebird, WithBothStrategiesSwitchedOffIsTheOriginalToTheBit) {
  SearchOptions options;
  options.algorithm = Algorithm::kLo;
  const SearchSummary lo = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kMlo;
  options.memory_rate = 0;
  options.distance_coefficient = 0;
  ExpectSame(Search(Sphere, kBox, options), lo);
}

TEST(Lyrebird, AblationsAreMloWithOneStrategyOff) {
  SearchOptions options;
  options.algorithm = Algorithm::kLoMblss;
  const SearchSummary mblss = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kLoDmlss;
  const SearchSummary dmlss = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kMlo;
  options.distance_coefficient = 0;
  ExpectSame(Search(Sphere, kBox, options), mblss);
  options.distance_coefficient = 0.25;
  options.memory_rate = 0;
  ExpectSame(Search(Sphere, kBox, options), dmlss);
}

TEST(Lyrebird, WithoutMemoryOneNumberAMoveAndOneACoordinateAreTheSame) {
  SearchOptions options;
  options.memory_rate = 0;
  const SearchSummary one = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kMloVector;
  ExpectSame(Search(Sphere, kBox, options), one);
  options.memory_rate = 1;
  const SearchSummary vector = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kMlo;
  EXPECT_NE(Search(Sphere, kBox, options).best.x, vector.best.x);
}

// Two local optima of equal width, at (-1, -1, -1) and (2, 2, 2); the second is lower by 0.1.
double TwoBowls(const double* x) {
  double first = 0, second = -0.1;
  for (int j = 0; j < 3; ++j) {
    first += (x[j] + 1) * (x[j] + 1);
    second += (x[j] - 2) * (x[j] - 2);
  }
  return std::min(first, second);
}

TEST(InitialPoints, AreMissingAndTheSearchIsMloToTheBit) {
  SearchOptions options;
  const SearchSummary mlo = Search(Sphere, kBox, options);
  options.algorithm = Algorithm::kMloShape;
  ExpectSame(Search(Sphere, kBox, options), mlo);
}

TEST(InitialPoints, SitInAtMostAQuarterOfTheFirstPopulationAndTheRestIsThatOfMlo) {
  const auto first_population = [](Algorithm algorithm, const Box& box) {
    std::vector<std::vector<double>> candidates;
    SearchOptions options;
    options.algorithm = algorithm;
    options.max_evaluations = options.population;
    Search(
        [&](const double* x) {
          candidates.emplace_back(x, x + 3);
          return Sphere(x);
        },
        box, options);
    return candidates;
  };
  Box box = kBox;
  box.initial.assign(9, {1, 9, -9});  // outside of the box: clipped to its bounds
  const auto mlo = first_population(Algorithm::kMlo, box);
  const auto shaped = first_population(Algorithm::kMloShape, box);
  ASSERT_EQ(shaped.size(), 20U);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(shaped[i], i < 5 ? (std::vector<double>{1, 3, -2}) : mlo[i]) << i;
  }
  box.initial.resize(2);
  const auto two = first_population(Algorithm::kMloShape, box);
  EXPECT_EQ(two[1], shaped[1]);
  EXPECT_EQ(two[2], mlo[2]);
}

TEST(InitialPoints, FindTheOptimumThatIsSuggested) {
  Box box = kBox;
  box.initial = {{2.1, 1.9, 2}};
  SearchOptions options;
  options.algorithm = Algorithm::kMloShape;
  for (options.seed = 0; options.seed < 20; ++options.seed) {
    EXPECT_LT(Search(TwoBowls, box, options).best.objective, -0.07) << options.seed;
  }
}

TEST(Lyrebird, BeatsRandomSearchOnASmoothBowl) {
  SearchOptions options;
  options.algorithm = Algorithm::kRandom;
  const double random = Search(Sphere, kBox, options).best.objective;
  options.algorithm = Algorithm::kMlo;
  EXPECT_LT(Search(Sphere, kBox, options).best.objective, 0.01 * random);
}

TEST(SearchOptions, OutOfRangeAreNamedWithTheirRange) {
  SearchOptions options;
  options.memory_rate = 1.5;
  const auto checked = ValidateOptions(options, kSearchOptionTable);
  ASSERT_FALSE(checked.has_value());
  EXPECT_EQ(checked.error().message, "memory-rate = 1.5 is outside [0, 1]");
  EXPECT_TRUE(ValidateOptions(SearchOptions{}, kSearchOptionTable).has_value());
  options = {};
  options.population = 100000;
  EXPECT_EQ(ValidateOptions(options, kSearchOptionTable).error().message,
            "population = 100000 is outside [4, 20000]");
}

TEST(Search, WorksOnOneDimensionAndOnAPointBox) {
  const Box line = {{0}, {4}};
  const auto parabola = [](const double* x) { return (x[0] - 1) * (x[0] - 1); };
  EXPECT_NEAR(Search(parabola, line, {}).best.x[0], 1, 0.05);
  const Box point = {{2}, {2}};
  EXPECT_EQ(Search(parabola, point, {}).best.objective, 1);
}

}  // namespace
}  // namespace lyrefit
