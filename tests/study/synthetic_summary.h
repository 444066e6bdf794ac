#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/compare.h"

namespace lyrefit {

// Synthetic results of one run: RMSE after the search, after the polish of its best candidate and
// after all starts, relative to the reference.
struct SyntheticRun {
  double searched;
  double own;
  double hybrid;
};

inline AlgorithmResult SyntheticAlgorithm(const std::string& algorithm, std::int64_t budget,
                                          const std::vector<SyntheticRun>& runs,
                                          double search_ms = 10) {
  AlgorithmResult compared;
  compared.algorithm = algorithm;
  compared.name = budget > 0 ? algorithm + "@" + std::to_string(budget) : algorithm;
  compared.budget = budget;
  if (algorithm == "shape") compared.kind = AlgorithmKind::kShape;
  if (algorithm == "default") compared.kind = AlgorithmKind::kDefault;
  for (const SyntheticRun& made : runs) {
    RunRecord run;
    run.run = static_cast<int>(compared.runs.size());
    run.searched_A = 2e-3 * made.searched;  // 2 mA: reference of every synthetic device
    run.plain_polished_A = run.searched_A;
    run.own_polished_A = 2e-3 * made.own;
    run.polished_A = 2e-3 * made.hybrid;
    run.evaluations = budget;
    run.search_seconds = 1e-3 * search_ms;
    run.plain_seconds = 1e-3;
    run.own_seconds = 5e-3;
    run.polish_seconds = 30e-3;
    compared.runs.push_back(std::move(run));
  }
  return compared;
}

inline ProblemResult SyntheticDevice(const std::string& name, const std::string& problem,
                                     std::vector<AlgorithmResult> algorithms) {
  ProblemResult device;
  device.curve_name = name;
  device.problem = problem;
  device.objective = Objective::kSolvedCurrent;
  device.reference.rmse_A = 2e-3;
  device.reference.origin = "best of all runs";
  device.algorithms = std::move(algorithms);
  return device;
}

inline Comparison SyntheticComparison(std::vector<ProblemResult> devices) {
  Comparison comparison;
  comparison.options.runs = 1;
  comparison.problems = std::move(devices);
  return comparison;
}

}  // namespace lyrefit
