#include "paper/budget_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "lyrefit/report/figure.h"

namespace lyrefit {
namespace {

struct DrawnLevel {
  const char* title;
  RunSpread AlgorithmResult::*stage;
  int RunSpread::*hits;
};

constexpr std::array<DrawnLevel, 4> kDrawnLevels = {
    {{"search alone", &AlgorithmResult::searched, &RunSpread::within_1e6},
     {"one plain solve", &AlgorithmResult::plain_polished, &RunSpread::within_1e9},
     {"best candidate's polish", &AlgorithmResult::own_polished, &RunSpread::within_1e9},
     {"all starts", &AlgorithmResult::polished, &RunSpread::within_1e9}}};

std::vector<std::string> Algorithms(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const AlgorithmResult& compared : problem.algorithms) {
    if (std::find(names.begin(), names.end(), compared.algorithm) == names.end()) {
      names.push_back(compared.algorithm);
    }
  }
  return names;
}

// Coincident lines stay visible: the first is drawn widest.
Series ShareLine(const std::string& name, int index, double width) {
  Series series{SeriesKind::kLineAndPoints, LookOf(index), width, 1 + 0.15 * width};
  series.name = name;
  return series;
}

Axis BudgetAxis(double low, double high) {
  Axis axis{"Evaluations of the search", low, high};
  axis.log = true;
  return axis;
}

Axis ShareAxis() {
  Axis axis{"Runs that hit (%)", -4, 104};
  axis.first_tick = 0;
  axis.tick_step = 20;
  return axis;
}

Panel BudgetPanel(const ProblemResult& problem, const std::vector<std::string>& algorithms,
                  const DrawnLevel& level) {
  const char* const models[] = {"SD", "DD", "TD"};
  Panel panel{fmt::format("{} {}: {}", problem.curve_name,
                          models[static_cast<int>(problem.model) - 1], level.title)};
  double least = 1e300, most = 0;
  const int count = static_cast<int>(algorithms.size());
  const double step = std::min(1.8, 9.0 / count);
  for (int a = 0; a < count; ++a) {
    Series series = ShareLine(algorithms[a], a, 1.3 + step * (count - 1 - a));
    for (const AlgorithmResult& compared : problem.algorithms) {
      if (compared.algorithm != algorithms[a]) continue;
      const double budget = static_cast<double>(compared.search.max_evaluations);
      least = std::min(least, budget);
      most = std::max(most, budget);
      series.Add(budget, 100.0 * ((compared.*level.stage).*level.hits) /
                             static_cast<double>(compared.runs.size()));
    }
    panel.series.push_back(std::move(series));
  }
  panel.x = BudgetAxis(least / 1.6, most * 1.6);
  panel.y = ShareAxis();
  return panel;
}

Figure BudgetFigure(const Comparison& comparison) {
  const std::vector<std::string> algorithms = Algorithms(comparison.problems[0]);
  Figure figure{fmt::format("Share of {} runs that hit: within 1e-6 of the reference (search "
                            "alone) or 1e-9 (polished), {}; of equal lines the first is the widest",
                            comparison.options.runs, ToText(comparison.options.objective)),
                LegendOf(algorithms, LegendMark::kLineAndPoint)};
  figure.columns = static_cast<int>(kDrawnLevels.size());
  for (const ProblemResult& problem : comparison.problems) {
    for (const DrawnLevel& level : kDrawnLevels) {
      figure.panels.push_back(BudgetPanel(problem, algorithms, level));
    }
  }
  return figure;
}

}  // namespace

Expected<void> PlotBudget(const Comparison& comparison, const std::string& path) {
  if (comparison.problems.empty()) return Fail("no problem was completed: nothing to draw", path);
  return DrawFigure(BudgetFigure(comparison), path);
}

}  // namespace lyrefit
