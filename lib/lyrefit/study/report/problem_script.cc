#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lyrefit/study/problem_summary.h"
#include "lyrefit/study/report/compare_script.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewRows = 4;  // more rows of panels get less height each

constexpr char kLevelTitles[][24] = {"search alone", "one plain solve", "best candidate's polish",
                                     "all starts"};

// Algorithms of all problems in their order: the searches first, then those without a budget.
std::vector<std::string> AlgorithmsOf(const std::vector<ProblemSummary>& summaries) {
  std::vector<std::string> names;
  for (const bool search : {true, false}) {
    for (const ProblemSummary& summary : summaries) {
      for (const AlgorithmSummary& compared : summary.algorithms) {
        if ((compared.budget > 0) != search) continue;
        if (std::find(names.begin(), names.end(), compared.algorithm) != names.end()) continue;
        names.push_back(compared.algorithm);
      }
    }
  }
  return names;
}

// An axis with a tick at every budget.
Axis AxisOf(const std::vector<ProblemSummary>& summaries) {
  std::set<std::int64_t> budgets;
  for (const ProblemSummary& summary : summaries) {
    for (const AlgorithmSummary& compared : summary.algorithms) {
      if (compared.budget > 0) budgets.insert(compared.budget);
    }
  }
  const bool none = budgets.empty();
  if (none) budgets = {1, 10};
  const double air = none ? 1 : 1.6;
  Axis axis = BudgetAxis(static_cast<double>(*budgets.begin()) / air,
                         static_cast<double>(*budgets.rbegin()) * air);
  for (const std::int64_t budget : budgets) {
    const auto place = static_cast<double>(budget);
    axis.ticks.push_back({fmt::format("{:g}", place), place});
  }
  return axis;
}

// A panel. An algorithm without a budget is a horizontal line.
Panel ProblemPanel(const ProblemSummary& summary, const std::vector<std::string>& names,
                   std::size_t level, const Axis& budgets) {
  Panel panel{fmt::format("{}: {}", summary.name, kLevelTitles[level]), budgets, ShareAxis()};
  const int count = static_cast<int>(names.size());
  const double step = std::min(1.2, 6.0 / count);
  for (int a = 0; a < count; ++a) {
    Series series = ShareLine(names[a], a, 1.2 + step * (count - 1 - a));
    for (const AlgorithmSummary& compared : summary.algorithms) {
      const auto& at = compared.At(kPolishLevels[level]);
      if (compared.algorithm != names[a] || !at) continue;
      const double share = 100.0 * at->hits / std::max(at->runs, 1);
      if (compared.budget > 0) {
        series.Add(static_cast<double>(compared.budget), share);
        continue;
      }
      series.kind = SeriesKind::kLine;
      series.width = 1.6;
      series.Add(budgets.low, share);
      series.Add(budgets.high, share);
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

}  // namespace

Figure ProblemFigure(const Comparison& comparison) {
  const std::vector<ProblemSummary> summaries = SummariseProblems(comparison);
  const std::vector<std::string> names = AlgorithmsOf(summaries);
  const Axis budgets = AxisOf(summaries);
  Figure figure{
      "Share of runs that hit: within 1e-6 of the best known optimum of the device; of "
      "equal lines the first is the widest; lines all across have no budget",
      LegendOf(names, LegendMark::kLineAndPoint)};
  figure.columns = static_cast<int>(kPolishLevels.size());
  for (const ProblemSummary& summary : summaries) {
    for (std::size_t level = 0; level < kPolishLevels.size(); ++level) {
      figure.panels.push_back(ProblemPanel(summary, names, level, budgets));
      if (summaries.size() > kFewRows) figure.panels.back().height = 180;
    }
  }
  return figure;
}

}  // namespace lyrefit
