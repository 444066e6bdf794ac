#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/compare.h"
#include "studies/landscape.h"

namespace lyrefit {

// The first devices of a landscape problem.
inline std::vector<CompareCurve> SyntheticSubjects(const std::string& problem, int devices) {
  auto cases = MakeLandscape(problem, devices, 0);
  EXPECT_TRUE(cases) << cases.error().ToString();
  std::vector<CompareCurve> subjects;
  for (LandscapeCase& made : *cases) subjects.push_back(SubjectOf(std::move(made)));
  return subjects;
}

// Two searches with two budgets each, the starts from the curve's shape, and the default fit.
inline std::vector<ComparedAlgorithm> SummaryAlgorithms() {
  std::vector<ComparedAlgorithm> algorithms =
      BudgetAlgorithms({Algorithm::kMlo, Algorithm::kRandom}, {10, 40});
  algorithms.push_back(OwnAlgorithm(AlgorithmKind::kShape));
  algorithms.push_back(OwnAlgorithm(AlgorithmKind::kDefault));
  return algorithms;
}

inline CompareOptions SummaryStudyOptions() {
  CompareOptions options;
  options.runs = 1;
  options.plain_polish = true;
  options.rankings = false;
  options.multistart = 2;
  options.threads = 2;
  return options;
}

}  // namespace lyrefit
