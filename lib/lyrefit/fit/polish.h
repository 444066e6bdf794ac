#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lyrefit/fit/fit_report.h"
#include "lyrefit/refine/refine.h"

namespace lyrefit {

struct PolishStart {
  std::string origin;
  std::vector<double> p;
};

// All starts polished: the first start is the best bird, whose own end is kept apart.
struct PolishResult {
  RefineEnd best;
  RefineEnd first;
  RefineReport report;
};

// Separable descent from every start, then one bounded least-squares solve for each group of starts that
// the descent has brought to the same curve. Starts after the first are skipped when `stop` asks.
PolishResult PolishStarts(const RefineProblem& problem, const std::vector<PolishStart>& starts,
                          int threads, const std::function<bool()>& stop);

// The best bird, further elites, then the separable grid.
std::vector<PolishStart> CollectStarts(const RefineProblem& problem,
                                       const std::vector<std::vector<double>>& elites, int grid);

}  // namespace lyrefit
