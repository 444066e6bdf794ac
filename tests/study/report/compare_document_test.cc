#include "lyrefit/study/report/documents.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "lyrefit/report/text_layout.h"
#include "sample_comparison.h"

namespace lyrefit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The text with line breaks replaced by spaces, to search for whole sentences.
std::string Unwrapped(const std::string& text) {
  std::istringstream words(text);
  std::string line, word;
  while (words >> word) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::string Between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t first = text.find(begin);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find(end, first) - first);
}

void ExpectFitsTheTerminal(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), static_cast<std::size_t>(kTextWidth)) << line;
  }
  EXPECT_EQ(text.back(), '\n');
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

TEST(CompareText, FitsATerminalOf100Columns) {
  ExpectFitsTheTerminal(CompareText(SampleComparison()));
  ExpectFitsTheTerminal(CompareText(LargeComparison()));
}

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

TEST(CompareText, PutsManyCurvesIntoOneTableFirst) {
  const std::string text = CompareText(OfASet(SampleComparison()));
  const std::size_t overview = text.find("All curves: RMSE in A (measured-current) of 4 runs");
  ASSERT_NE(overview, std::string::npos);
  const std::size_t first = text.find("sandia_pvue125/8 (203.11 W/m2, 25.1 C), double-diode");
  ASSERT_NE(first, std::string::npos);
  EXPECT_LT(overview, first);
  EXPECT_LT(first, text.find("\n  Search alone: RMSE"));
  const std::string section = text.substr(overview, text.find("\n\n", overview) - overview);
  EXPECT_EQ(std::count(section.begin(), section.end(), '\n'), 1 + 6 + 2 + 3 * 6)
      << "a head, a line a problem, two of the long name, a row an algorithm:\n"
      << section;
  EXPECT_THAT(section, HasSubstr("algorithm "));
  EXPECT_THAT(section, HasSubstr("9.860e-04"));
  ExpectFitsTheTerminal(text);
  ExpectFitsTheTerminal(CompareText(OfASet(LargeComparison())));
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

TEST(CompareText, NeedsNoOverviewOfOneCurve) {
  EXPECT_THAT(CompareText(SampleComparison()), Not(HasSubstr("All curves")));
}

TEST(CompareText, SaysWhatWasCompared) {
  const std::string text = CompareText(SampleComparison());
  EXPECT_THAT(text, StartsWith("lyrefit 1.2.3: 3 algorithms, 4 runs each, on 2 problems\n"));
  EXPECT_THAT(text, HasSubstr("10 candidates x 100 iterations: 1010 evaluations at most a run"));
  EXPECT_THAT(text, HasSubstr("0 to 3 of seed 7"));
  EXPECT_THAT(text, HasSubstr("sample_cell, double-diode model, bounds literature"));
  EXPECT_THAT(text, HasSubstr("9.860218779e-04 A measured-current, best of all runs; not proved"));
  EXPECT_THAT(Unwrapped(text),
              HasSubstr("smallest possible exact p of Wilcoxon's test is 2^(1-4)"));
}

TEST(CompareText, LabelsEveryTableWithTheObjective) {
  Comparison comparison = SampleComparison();
  comparison.options.objective = Objective::kSolvedCurrent;
  const std::string text = CompareText(comparison);
  EXPECT_THAT(text, Not(HasSubstr("measured-current")));
  for (const char* title : {"  Search alone: ", "  Search and polish: ", "  Cost of a run"}) {
    EXPECT_THAT(Between(text, title, "\n"), HasSubstr("(solved-current)")) << title;
  }
}

TEST(CompareText, ShowsTheSpreadOfBothStages) {
  const std::string text = CompareText(SampleComparison());
  const std::string pure = Between(text, "Search alone", "\n\n");
  EXPECT_THAT(pure, HasSubstr("mlo        9.86022e-04  9.86022e-04  9.86022e-04  9.86022e-04"));
  EXPECT_THAT(pure, HasSubstr("random     1.02546e-03  1.04321e-03  1.04321e-03  1.06096e-03"));
  const std::string polished = Between(text, "Search and polish", "\n\n");
  EXPECT_THAT(polished, HasSubstr("random     9.860219e-04"));
}

TEST(CompareText, SaysThatNothingIsLeftOfTheRankingAfterThePolish) {
  const std::string text = CompareText(SampleComparison());
  EXPECT_THAT(text,
              HasSubstr("After the polish all 3 algorithms tie: 12 of 12 runs end within 1e-9 "
                        "of 9.860218779e-04 A."));
  EXPECT_THAT(text, HasSubstr("all 2.00; chi-square 0 with 2 degrees of freedom, p = 1"));
  EXPECT_THAT(text, HasSubstr("no pair differs: all runs of all algorithms are equal"));
}

TEST(CompareText, SaysWhoMissesAfterThePolish) {
  const std::string text = Unwrapped(CompareText(SampleComparison()));
  EXPECT_THAT(text,
              HasSubstr("After the polish 11 of 12 runs end within 1e-9 of 9.860218779e-04 A; "
                        "runs that do not: random 1. Of the ranking none of 3 pairs are left."));
}

TEST(CompareText, NamesThePairsThatFourRunsCannotTellApart) {
  const std::string text = Unwrapped(CompareText(SampleComparison()));
  EXPECT_THAT(text, HasSubstr("no pair is told apart (p at least 0.38; 4 of 4 runs differ)"));
  EXPECT_THAT(text, HasSubstr("no pair is told apart (p at least 1; 0 to 1 of 4 runs differ)"));
}

TEST(CompareText, NamesTheAlgorithmsThatAreBetter) {
  Comparison comparison = SampleComparison();
  std::vector<std::vector<double>> values(3);
  for (int r = 0; r < 20; ++r) {
    values[0].push_back(1 + r);
    values[1].push_back(1 + r + (r % 2 == 0 ? 0.1 : -0.1));
    values[2].push_back(2 + 2 * r);
  }
  comparison.problems[0].searched = RankAll(values);
  const std::string text = CompareText(comparison);
  EXPECT_THAT(text, HasSubstr("    mlo below random (p at most 5.7e-06)"));
  EXPECT_THAT(text, HasSubstr("    mlo not told from de (p at least"));
}

TEST(CompareText, CallsRoundingWhatIsRounding) {
  Comparison comparison = SampleComparison();
  std::vector<std::vector<double>> values(3);
  for (int r = 0; r < 20; ++r) {
    values[0].push_back(1 + 1e-15 * r);
    values[1].push_back(1 + 1e-13 + 1e-15 * r);
    values[2].push_back(2 + r);
  }
  ProblemResult& problem = comparison.problems[0];
  problem.searched = RankAll(values);
  for (int c = 0; c < 2; ++c) problem.algorithms[c].searched.within_1e9 = 4;
  const std::string text = Unwrapped(CompareText(comparison));
  EXPECT_THAT(text, HasSubstr("mlo below de, random"));
  EXPECT_THAT(text,
              HasSubstr("1 of these differences is rounding: all runs of both are within 1e-9 "
                        "of the reference"));
}

TEST(CompareText, LeavesOutWhatWasNotDone) {
  Comparison comparison = SampleComparison();
  comparison.options.polish = comparison.options.plain_polish = false;
  for (ProblemResult& problem : comparison.problems) {
    problem.polished = {};
    for (AlgorithmResult& c : problem.algorithms) {
      c.polished = c.own_polished = c.plain_polished = {};
    }
  }
  const std::string text = CompareText(comparison);
  EXPECT_THAT(text, Not(HasSubstr("Search and polish")));
  EXPECT_THAT(text, Not(HasSubstr("After the polish")));
  EXPECT_THAT(text, Not(HasSubstr("best only")));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(CompareText, StartsWithInterrupted) {
  Comparison comparison = SampleComparison();
  comparison.interrupted = true;
  comparison.problems[1].complete = false;
  comparison.problems[1].algorithms[2].runs.pop_back();
  const std::string text = CompareText(comparison);
  EXPECT_THAT(text, StartsWith("INTERRUPTED"));
  EXPECT_THAT(text, HasSubstr("are of those.\n\nlyrefit"));
  EXPECT_THAT(text, HasSubstr("of 4 runs, and runs within"));
  EXPECT_THAT(text, HasSubstr("of 3 to 4 of 4 runs, and runs within"));
  comparison.problems.clear();
  EXPECT_THAT(CompareText(comparison), HasSubstr("nothing was completed"));
  EXPECT_THAT(BudgetText(comparison), StartsWith("INTERRUPTED"));
  EXPECT_THAT(SensitivityText(comparison), StartsWith("INTERRUPTED"));
}

TEST(BudgetText, LeavesACellOpenWhereNoRunWasDone) {
  Comparison comparison =
      SampleComparison(BudgetAlgorithms({Algorithm::kMlo, Algorithm::kRandom}, {1000, 100, 10}));
  comparison.problems.pop_back();
  comparison.interrupted = true;
  comparison.problems[0].complete = false;
  comparison.problems[0].algorithms.pop_back();  // random@10
  EXPECT_THAT(BudgetText(comparison), testing::ContainsRegex("random +- +[0-4] +[0-4]\n"));
}

// MLO and random points with three budgets each. `missed`: number of runs of random points with the
// largest budget that did not hit.
Comparison BudgetComparison(int missed) {
  Comparison comparison =
      SampleComparison(BudgetAlgorithms({Algorithm::kMlo, Algorithm::kRandom}, {10, 100, 1000}));
  comparison.problems.pop_back();
  auto& algorithms = comparison.problems[0].algorithms;
  for (AlgorithmResult& compared : algorithms) {
    compared.searched.within_1e6 = 0;
    compared.plain_polished.within_1e9 = 2;
    compared.polished.within_1e9 = compared.own_polished.within_1e9 = 4;
  }
  algorithms[0].own_polished.within_1e9 = 3;
  algorithms[3].polished.within_1e9 = 3;
  algorithms[5].polished.within_1e9 -= missed;
  return comparison;
}

TEST(BudgetText, ShowsHitsByAlgorithmAndBudget) {
  const std::string text = BudgetText(BudgetComparison(0));
  ExpectFitsTheTerminal(text);
  EXPECT_THAT(Between(text, "  The best candidate's own polish", "\n\n"),
              HasSubstr("  algorithm  10  100  1000\n  mlo         3    4     4\n"
                        "  random      4    4     4"));
  EXPECT_THAT(Between(text, "  Evaluations from which on", "\n\n"),
              HasSubstr("mlo                   -            -             100          10"));
  EXPECT_THAT(text, HasSubstr("All starts (hybrid), runs of 4 within 1e-9 (measured-current)"));
}

TEST(BudgetText, SaysWhetherRandomPointsDoAsWell) {
  const std::string text = Unwrapped(BudgetText(BudgetComparison(0)));
  EXPECT_THAT(text,
              HasSubstr("Search alone: no algorithm hits in every run. With all starts: every "
                        "run hits with mlo from 10 evaluations on, with random from 100 "
                        "evaluations on. Random points need 100 evaluations where the best "
                        "search needs 10."));
  EXPECT_THAT(Unwrapped(BudgetText(BudgetComparison(1))),
              HasSubstr("Random points do not get there in every run."));
  Comparison level = BudgetComparison(0);
  level.problems[0].algorithms[3].polished.within_1e9 = 4;
  EXPECT_THAT(
      Unwrapped(BudgetText(level)),
      HasSubstr("With all starts: every algorithm hits in every run from 10 evaluations on. "
                "Random points do as well as any search."));
}

TEST(BudgetText, CountsABudgetOnlyIfAllLargerOnesHitToo) {
  Comparison comparison = BudgetComparison(0);
  comparison.problems[0].algorithms[1].polished.within_1e9 = 2;
  EXPECT_THAT(Unwrapped(BudgetText(comparison)), HasSubstr("with mlo from 1000 evaluations on"));
}

TEST(SensitivityText, ShowsGridsOfPmAndGamma) {
  const Comparison comparison = SampleComparison(SensitivityAlgorithms({0, 0.5}, {0.25, 1}, {}));
  const std::string text = SensitivityText(comparison);
  ExpectFitsTheTerminal(text);
  const std::string mean = Between(text, "mean RMSE in A (measured-current)", "\n\n");
  EXPECT_THAT(mean, HasSubstr("            gamma = 0.25    gamma = 1\n"
                              "  Pm = 0     9.86022e-04  1.00032e-03\n"
                              "  Pm = 0.5   1.04321e-03  1.11470e-03"));
  EXPECT_THAT(text, HasSubstr("smallest RMSE in A (measured-current)"));
  EXPECT_THAT(text, HasSubstr("standard deviation of the RMSE in A (measured-current)"));
  EXPECT_THAT(text, HasSubstr("Polished (all starts): runs of 4 within 1e-9 (measured-current)"));
  EXPECT_THAT(Unwrapped(text),
              HasSubstr("The lowest mean of the search alone is 9.86022e-04 A at Pm "
                        "= 0, gamma = 0.25. After the polish 16 of 16 runs"));
  EXPECT_THAT(Unwrapped(text), HasSubstr("Table 17 is captioned minimum and holds means"));
}

}  // namespace
}  // namespace lyrefit
