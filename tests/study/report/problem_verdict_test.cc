#include "lyrefit/study/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/synthetic_summary.h"

namespace lyrefit {
namespace {

// Synthetic results of one algorithm with one budget: fifty devices with one run each.
struct SummaryRow {
  const char* algorithm;
  std::int64_t budget;
  int own;
  int hybrid;
  double search_ms;
};

Comparison Fifty(const std::vector<SummaryRow>& rows) {
  std::vector<ProblemResult> devices;
  for (int d = 0; d < 50; ++d) {
    std::vector<AlgorithmResult> algorithms;
    for (const SummaryRow& row : rows) {
      const SyntheticRun run = {9, d < row.own ? 1.0 : 2, d < row.hybrid ? 1.0 : 2};
      algorithms.push_back(SyntheticAlgorithm(row.algorithm, row.budget, {run}, row.search_ms));
    }
    devices.push_back(SyntheticDevice("x " + std::to_string(d), "x", std::move(algorithms)));
  }
  return SyntheticComparison(std::move(devices));
}

std::string Sentence(const std::vector<SummaryRow>& rows) {
  const Comparison comparison = Fifty(rows);
  return VerdictText(SummariseProblems(comparison)[0]);
}

TEST(VerdictText, SaysThatNoSearchIsNeeded) {
  EXPECT_EQ(Sentence({{"shape", 0, 0, 50, 0},
                      {"mlo", 100, 40, 50, 5},
                      {"mlo", 1000, 47, 50, 50},
                      {"random", 100, 30, 50, 5},
                      {"random", 1000, 48, 50, 305}}),
            "x: no search is needed: starts from the curve's shape alone hit 50 of 50 (30 ms); of "
            "the searches random reaches 48 of 50 with the best candidate's own polish from 1000 "
            "evaluations (310 ms)");
}

TEST(VerdictText, NamesTheSearchThatWillDo) {
  EXPECT_EQ(
      Sentence({{"shape", 0, 0, 12, 0},
                {"mlo", 100, 40, 44, 5},
                {"mlo", 1000, 49, 50, 50},
                {"random", 100, 30, 44, 5},
                {"random", 1000, 47, 50, 50}}),
      "x: mlo will do: starts from the curve's shape alone hit 12 of 50 (30 ms); of the "
      "searches mlo reaches 49 of 50 with the best candidate's own polish from 1000 evaluations "
      "(55 ms); random points reach 50 of 50 with all starts from 1000 evaluations (80 ms)");
}

TEST(VerdictText, SaysThatNothingIsEnough) {
  EXPECT_EQ(
      Sentence({{"mlo", 100, 40, 47, 5}, {"random", 100, 30, 44, 5}}),
      "x: nothing is enough: no search reaches 48 of 50 from any budget on; the best, mlo, "
      "hits 47 with all starts at 100 evaluations (35 ms); random points do not: at most 44 of 50, "
      "with all starts at 100 evaluations (35 ms)");
}

TEST(VerdictText, SaysThatNobodyEverHits) {
  EXPECT_EQ(Sentence({{"mlo", 100, 0, 0, 5}, {"random", 100, 0, 0, 8}}),
            "x: nothing is enough: the searches never hit; random points hit in none");
}

TEST(PeerText, SaysHowManyTimesFasterOrThatNoneHitsAsOften) {
  const Comparison equal = Fifty({{"default", 0, 0, 49, 2}, {"pagmo:de", 1000, 50, 50, 123}});
  EXPECT_EQ(PeerText(SummariseProblems(equal)[0]),
            "default (49 of 50, 32 ms) is 4 times faster than pagmo:de@1000 (50 of 50, 128 ms)");
  const Comparison slower = Fifty({{"default", 0, 0, 49, 2}, {"pagmo:de", 1000, 50, 50, 11}});
  EXPECT_EQ(PeerText(SummariseProblems(slower)[0]),
            "default (49 of 50, 32 ms) is 2 times slower than pagmo:de@1000 (50 of 50, 16 ms)");
  const Comparison fewer = Fifty({{"default", 0, 0, 49, 2}, {"pagmo:de", 1000, 40, 50, 123}});
  EXPECT_EQ(PeerText(SummariseProblems(fewer)[0]),
            "default (49 of 50, 32 ms) is 8 times faster than pagmo:de@1000 (40 of 50, 128 ms), "
            "run 2 times");
  const Comparison never = Fifty({{"default", 0, 0, 49, 2}, {"pagmo:de", 1000, 0, 0, 123}});
  EXPECT_EQ(PeerText(SummariseProblems(never)[0]), "default (49 of 50, 32 ms): no peer ever hits");
  const Comparison none = Fifty({{"default", 0, 0, 49, 2}, {"mlo", 1000, 48, 50, 123}});
  EXPECT_EQ(PeerText(SummariseProblems(none)[0]), "");
}

}  // namespace
}  // namespace lyrefit
