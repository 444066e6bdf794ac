#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/algorithms.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

// Results written by hand: three algorithms with four runs each. All polished runs but one end at
// one value.
inline ProblemResult SampleProblem(Model model, const std::vector<ComparedAlgorithm>& algorithms) {
  constexpr double kBest = 9.8602187789e-4;
  ProblemResult problem;
  problem.curve_name = "sample_cell";
  problem.model = model;
  problem.bounds_name = "literature";
  problem.reference = {
      kBest, false, kUnknown, kUnknown, "best of all runs", {0.76, 3e-7, 1.48, 0.036, 53}};
  problem.parameters = {"photocurrent", "saturation_current", "n", "Rs", "Rsh"};
  std::vector<std::vector<double>> searched, polished;
  for (std::size_t c = 0; c < algorithms.size(); ++c) {
    std::vector<RunOutcome> outcomes(4);
    for (int r = 0; r < 4; ++r) {
      RunRecord& run = outcomes[r].record;
      run.run = r;
      const double excess = 0.01 * static_cast<double>(c * c) * (1 + 0.3 * r);
      const bool missed = c == 2 && r == 3 && model == Model::kDoubleDiode;
      run.searched_A = kBest * (1 + excess);
      run.plain_polished_A = kBest * (1 + (r == 0 ? 1e-4 : 0));
      run.own_polished_A = kBest;
      run.polished_A = kBest * (missed ? 1.003 : 1 + 1e-13 * r);
      run.evaluations = 1010;
      run.search_seconds = 0.0123;
      run.polish_seconds = 0.002;
      outcomes[r].gains = {{0, 10, 0.5}, {40, 410, 2e-3}, {100, 1010, run.searched_A}};
    }
    problem.algorithms.push_back(Summarise(algorithms[c], &outcomes, kBest, 1e-3));
    searched.emplace_back();
    polished.emplace_back();
    for (const RunRecord& run : problem.algorithms.back().runs) {
      searched.back().push_back(run.searched_A);
      polished.back().push_back(run.polished_A);
    }
  }
  problem.searched = RankAll(searched);
  problem.polished = RankJoined(polished);
  return problem;
}

inline Comparison SampleComparison(const std::vector<ComparedAlgorithm>& algorithms) {
  Comparison comparison;
  comparison.version = "1.2.3";
  comparison.options.models = {Model::kSingleDiode, Model::kDoubleDiode};
  comparison.options.runs = 4;
  comparison.options.seed = 7;
  comparison.options.plain_polish = true;
  comparison.problems = {SampleProblem(Model::kSingleDiode, algorithms),
                         SampleProblem(Model::kDoubleDiode, algorithms)};
  comparison.seconds = 1.5;
  return comparison;
}

inline Comparison SampleComparison() {
  SearchOptions search;
  search.population = 10;
  search.iterations = 100;
  return SampleComparison(
      PlainAlgorithms({Algorithm::kMlo, Algorithm::kDe, Algorithm::kRandom}, search));
}

}  // namespace lyrefit
