#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "../repeats.h"
#include "json_keys.h"
#include "lyrefit/estimate/fit/fit.h"
#include "lyrefit/study/problem_summary.h"
#include "lyrefit/study/report/documents.h"
#include "summary_study.h"
#include "temp_folder.h"

namespace lyrefit {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Comparison Compared(const std::vector<CompareCurve>& subjects, const CompareOptions& options,
                    const Observer& observer = {}) {
  const auto comparison = Compare(subjects, SummaryAlgorithms(), options, observer);
  EXPECT_TRUE(comparison) << comparison.error().ToString();
  return *comparison;
}

nlohmann::json Figures(const Comparison& comparison) {
  nlohmann::json figures = nlohmann::json::parse(CompareJson(comparison));
  RemoveSeconds(&figures);
  return figures;
}

std::vector<CompareCurve> StringsAndFamilies() {
  std::vector<CompareCurve> subjects = SyntheticSubjects("strings_2", 2);
  for (CompareCurve& family : SyntheticSubjects("family_offsets", 1)) {
    subjects.push_back(std::move(family));
  }
  return subjects;
}

TEST(CompareSummaries, TakesDevicesWithEffectsAndFamilies) {
  SKIP_IF_SANITIZED();
  const Comparison comparison = Compared(StringsAndFamilies(), SummaryStudyOptions());
  ASSERT_EQ(comparison.problems.size(), 3U);
  const auto summaries = SummariseProblems(comparison);
  ASSERT_EQ(summaries.size(), 2U);
  EXPECT_EQ(summaries[0].name, "strings_2");
  EXPECT_EQ(summaries[0].devices.size(), 2U);
  EXPECT_EQ(summaries[1].name, "family_offsets");
  for (const ProblemResult& problem : comparison.problems) {
    EXPECT_EQ(problem.objective, Objective::kSolvedCurrent);
    EXPECT_EQ(problem.reference.points, 2);
    EXPECT_EQ(problem.reference.parameters.size(), problem.parameters.size());
    ASSERT_EQ(problem.algorithms.size(), 6U);
    for (const AlgorithmResult& compared : problem.algorithms) {
      const RunRecord& run = compared.runs.at(0);
      EXPECT_GE(run.polished_A, problem.reference.rmse_A) << compared.name;
      EXPECT_LE(run.polished_A, run.searched_A) << compared.name;
      EXPECT_EQ(run.parameters.size(), problem.parameters.size());
      if (compared.kind != AlgorithmKind::kSearch) continue;
      EXPECT_LE(run.evaluations, compared.budget);
      EXPECT_EQ(run.own_parameters.size(), problem.parameters.size());
      EXPECT_GE(run.plain_seconds, 0);
      EXPECT_LE(run.plain_polished_A, run.searched_A * (1 + 1e-9));
      EXPECT_LE(run.own_polished_A, run.searched_A * (1 + 1e-9));
    }
  }
  EXPECT_EQ(comparison.problems[0].parameters.at(comparison.problems[0].first_effect),
            "substrings.d1");
}

TEST(CompareSummaries, RunsADefaultFitAsItIs) {
  SKIP_IF_SANITIZED();
  const CompareCurve subject = SyntheticSubjects("strings_2", 1)[0];
  const Comparison comparison = Compared({subject}, SummaryStudyOptions());
  FitOptions fit;
  fit.with = subject.with;
  fit.bounds = subject.bounds;
  fit.model = *subject.model;
  fit.intervals = Intervals::kNone;
  fit.search = FitOptions::SearchBesideShapes();
  const auto report = Fit(subject.curve, fit);
  ASSERT_TRUE(report);
  const RunRecord& run = comparison.problems[0].algorithms[5].runs[0];
  EXPECT_EQ(run.polished_A, report->rmse.refined.solved_current_A);
  EXPECT_EQ(run.evaluations, report->search.evaluations);
}

TEST(CompareSummaries, GivesTheSameBitsOnAnyNumberOfThreads) {
  SKIP_IF_SANITIZED();
  CompareOptions options = SummaryStudyOptions();
  const nlohmann::json two = Figures(Compared(StringsAndFamilies(), options));
  options.threads = 1;
  EXPECT_EQ(Figures(Compared(StringsAndFamilies(), options)), two);
}

TEST(CompareSummaries, IsTakenUpWithTheSameBits) {
  SKIP_IF_SANITIZED();
  const TempFolder folder;
  CompareOptions options = SummaryStudyOptions();
  const nlohmann::json whole = Figures(Compared(StringsAndFamilies(), options));
  options.journal = folder.Path("study.jsonl");
  const Comparison part = Compared(StringsAndFamilies(), options, [](const Progress& progress) {
    return progress.iteration >= 8 ? ObserverAction::kStop : ObserverAction::kContinue;
  });
  EXPECT_TRUE(part.interrupted);
  EXPECT_EQ(Figures(Compared(StringsAndFamilies(), options)), whole);
  const Comparison again = Compared(StringsAndFamilies(), options);
  EXPECT_THAT(again.remarks, ElementsAre(HasSubstr("18 of 18 runs were done before")));
  EXPECT_EQ(Figures(again), whole);
}

TEST(CompareSummaries, CountsTheEvaluationsOfInitialPoints) {
  const TempFolder folder;
  CompareOptions options = SummaryStudyOptions();
  options.journal = folder.Path("study.jsonl");
  for (int time = 0; time < 2; ++time) {
    const auto comparison = Compare(SyntheticSubjects("strings_2", 1),
                                    BudgetAlgorithms({Algorithm::kMloShape}, {40}), options);
    ASSERT_TRUE(comparison) << comparison.error().ToString();
    const RunRecord& run = comparison->problems.at(0).algorithms.at(0).runs.at(0);
    EXPECT_GT(run.curve_evaluations, run.evaluations) << time;
  }
}

TEST(CompareSummaries, IsNotTakenUpByAnotherStudy) {
  const TempFolder folder;
  CompareOptions options = SummaryStudyOptions();
  options.journal = folder.Path("study.jsonl");
  Compared(SyntheticSubjects("strings_2", 1), options);
  const auto refusal = [&](const std::vector<CompareCurve>& subjects) {
    const auto comparison = Compare(subjects, SummaryAlgorithms(), options);
    return comparison ? "not refused" : comparison.error().ToString();
  };
  EXPECT_THAT(refusal(SyntheticSubjects("strings_2", 2)),
              HasSubstr("begun with number of curves: 1"));
  std::vector<CompareCurve> other = SyntheticSubjects("strings_2", 1);
  other[0].with[0].ranges["w1"] = {0.25, 0.25};
  EXPECT_THAT(refusal(other), HasSubstr("begun with effects of curve 1 strings_2 0"));
  other = SyntheticSubjects("strings_2", 1);
  other[0].problem = "lights";
  EXPECT_THAT(refusal(other), HasSubstr("begun with problem of curve 1 strings_2 0: strings_2"));
  options.multistart = 3;
  EXPECT_THAT(refusal(SyntheticSubjects("strings_2", 1)), HasSubstr("begun with multistart: 2"));
}

TEST(CompareSummaries, NamesWhatCannotBeFitted) {
  std::vector<CompareCurve> subjects = SyntheticSubjects("family_offsets", 1);
  subjects[0].set->curves.resize(1);
  const auto comparison = Compare(subjects, SummaryAlgorithms(), SummaryStudyOptions());
  ASSERT_FALSE(comparison);
  EXPECT_THAT(comparison.error().ToString(), HasSubstr("cannot be compared on family_offsets 0"));
}

}  // namespace
}  // namespace lyrefit
