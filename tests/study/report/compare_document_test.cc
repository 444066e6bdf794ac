#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "golden.h"
#include "sample_comparison.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;

// Results of a sample comparison, repeated for three curves of a set.
Comparison OfASet(Comparison comparison) {
  std::vector<ProblemResult> problems;
  for (const char* name :
       {"sandia_pvue125/1234 (987.25 W/m2, 24.6 C)", "sandia_pvue125/8 (203.11 W/m2, 25.1 C)",
        "outdoor sweeps of a Mitsubishi PV-UE125MF5N module/16 (1001.4 W/m2, 59.9 C)"}) {
    for (ProblemResult problem : comparison.problems) {
      problem.curve_name = name;
      problems.push_back(std::move(problem));
    }
  }
  comparison.problems = std::move(problems);
  return comparison;
}

// Twelve algorithms with the longest possible names.
Comparison LargeComparison() {
  std::vector<ComparedAlgorithm> algorithms;
  for (int i = 0; i < 12; ++i) {
    algorithms.push_back(
        {"pagmo:simulated_annealin" + std::string(1, static_cast<char>('a' + i)), "", {}, {}});
  }
  return SampleComparison(algorithms);
}

// Ranks of twenty runs of three algorithms. value(c, r): result of run r of algorithm c.
template <class Value>
Ranking RanksOf(const Value& value) {
  std::vector<std::vector<double>> values(3);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 20; ++r) values[c].push_back(value(c, r));
  }
  return RankAll(values);
}

TEST(CompareText, SaysWhatTheGoldenFileHas) {
  Golden golden("compare");
  const auto add = [&](const std::string& title, const auto& change) {
    Comparison comparison = SampleComparison();
    change(&comparison);
    golden.AddChanges(title, CompareText(comparison));
  };
  golden.Add("three algorithms", CompareText(SampleComparison()));
  add("solved current",
      [](Comparison* comparison) { comparison->options.objective = Objective::kSolvedCurrent; });
  add("some algorithms are better", [](Comparison* comparison) {
    comparison->problems[0].searched = RanksOf([](int c, int r) {
      return c == 2 ? 2.0 + 2 * r : 1 + r + (c == 0 ? 0 : r % 2 == 0 ? 0.1 : -0.1);
    });
  });
  add("differences of rounding", [](Comparison* comparison) {
    ProblemResult& problem = comparison->problems[0];
    problem.searched = RanksOf(
        [](int c, int r) { return c == 2 ? 2.0 + r : 1 + (c == 0 ? 0 : 1e-13) + 1e-15 * r; });
    for (int c = 0; c < 2; ++c) problem.algorithms[c].searched.within_1e9 = 4;
  });
  add("no polish", [](Comparison* comparison) {
    comparison->options.polish = comparison->options.plain_polish = false;
    for (ProblemResult& problem : comparison->problems) {
      problem.polished = {};
      for (AlgorithmResult& c : problem.algorithms) {
        c.polished = c.own_polished = c.plain_polished = {};
      }
    }
  });
  add("interrupted", [](Comparison* comparison) {
    comparison->interrupted = true;
    comparison->problems[1].complete = false;
    comparison->problems[1].algorithms[2].runs.pop_back();
  });
  add("interrupted at once", [](Comparison* comparison) {
    comparison->interrupted = true;
    comparison->problems.clear();
  });
  golden.Check();
}

TEST(CompareText, OfASetSaysWhatTheGoldenFileHas) {
  Golden golden("compare_set");
  golden.Add("three curves", CompareText(OfASet(SampleComparison())));
  golden.Check();
  NarrowLines(CompareText(LargeComparison()));
  NarrowLines(CompareText(OfASet(LargeComparison())));
}

TEST(CompareDocument, NamesTheRowsOfEachCurveInOneTable) {
  const std::string html = DrawHtml(CompareDocument(OfASet(SampleComparison())));
  EXPECT_THAT(html,
              HasSubstr("colspan=\"9\">sandia_pvue125/8 (203.11 W/m2, 25.1 C), double-diode"));
  EXPECT_THAT(html, HasSubstr("<caption>Search alone: RMSE in A (measured-current) of 4 runs"));
  const std::string markdown = DrawMarkdown(CompareDocument(SampleComparison()));
  EXPECT_THAT(markdown, HasSubstr("- **Ranks, search alone: Friedman over 4 runs**\n  - "));
  EXPECT_THAT(markdown, HasSubstr("*Search and polish: RMSE in A"));
}

}  // namespace
}  // namespace lyrefit
