#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "lyrefit/report/panels.h"
#include "lyrefit/study/pool.h"
#include "lyrefit/study/report/compare_script.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewRows = 4;  // more of them are lower each

constexpr char kLevelTitles[][24] = {"search alone", "one plain solve", "best bird's polish",
                                     "all starts"};

// Of all problems, in the order they come: the searches first, then what has no budget.
std::vector<std::string> LegendOf(const std::vector<PooledProblem>& pools) {
  std::vector<std::string> names;
  for (const bool search : {true, false}) {
    for (const PooledProblem& pool : pools) {
      for (const PooledContender& contender : pool.contenders) {
        if ((contender.budget > 0) != search) continue;
        if (std::find(names.begin(), names.end(), contender.algorithm) != names.end()) continue;
        names.push_back(contender.algorithm);
      }
    }
  }
  return names;
}

struct BudgetRange {
  double least = 1e300;
  double most = 0;
  std::string ticks;  // for gnuplot, one at every budget
};

BudgetRange RangeOf(const std::vector<PooledProblem>& pools) {
  BudgetRange range;
  std::set<std::int64_t> budgets;
  for (const PooledProblem& pool : pools) {
    for (const PooledContender& contender : pool.contenders) {
      if (contender.budget == 0) continue;
      budgets.insert(contender.budget);
      range.least = std::min(range.least, static_cast<double>(contender.budget));
      range.most = std::max(range.most, static_cast<double>(contender.budget));
    }
  }
  if (budgets.empty()) return {1, 10, "1, 10"};
  for (const std::int64_t budget : budgets) {
    range.ticks += fmt::format("{}{}", range.ticks.empty() ? "" : ", ", budget);
  }
  range.least /= 1.6;
  range.most *= 1.6;
  return range;
}

// A contender without a budget is a line all across.
std::string PoolPanel(const PooledProblem& pool, const std::vector<std::string>& names,
                      PolishLevel level, const BudgetRange& range, const std::string& terminal) {
  std::string data, plot;
  const int count = static_cast<int>(names.size());
  const double step = std::min(1.2, 6.0 / count);
  for (int a = 0; a < count; ++a) {
    std::string points;
    bool across = false;
    for (const PooledContender& contender : pool.contenders) {
      const auto& at = contender.At(level);
      if (contender.algorithm != names[a] || !at) continue;
      const double share = 100.0 * at->hits / std::max(at->runs, 1);
      across = contender.budget == 0;
      if (across) {
        points += fmt::format("{} {}\n{} {}\n", range.least, share, range.most, share);
      } else {
        points += fmt::format("{} {}\n", contender.budget, share);
      }
    }
    if (points.empty()) continue;
    data += fmt::format("$a{} << END_OF_DATA\n{}END_OF_DATA\n", a, points);
    const double width = 1.2 + step * (count - 1 - a);
    plot += fmt::format("{} $a{} using 1:2 with ", plot.empty() ? "plot" : ", \\\n", a);
    plot += across ? fmt::format("lines lw 1.6 {}", LineLook(a))
                   : fmt::format("linespoints lw {:.2f} pt {} ps {:.2f} {}", width, PointLook(a),
                                 PointSize(terminal) * (1 + 0.15 * width), LineLook(a));
  }
  if (plot.empty()) plot = "plot NaN notitle";
  return data +
         fmt::format(
             "set logscale x\nset xrange [{:g}:{:g}]\nset format x '%g'\nset xtics ({})\n"
             "set yrange [-4:104]\nset ytics 0,20\n",
             range.least, range.most, range.ticks) +
         plot + "\n";
}

}  // namespace

std::string PoolScript(const Comparison& comparison, const std::string& terminal) {
  const std::vector<PooledProblem> pools = PoolProblems(comparison);
  const std::vector<std::string> names = LegendOf(pools);
  const BudgetRange range = RangeOf(pools);
  const int levels = static_cast<int>(kPolishLevels.size());
  const PanelPage page(static_cast<int>(pools.size()) * levels, levels,
                       "Share of runs that hit: within 1e-6 of the best known optimum of the "
                       "device; of equal lines the first is the widest; lines all across have no "
                       "budget",
                       LegendMark::kLineAndPoint, names, 0, pools.size() > kFewRows ? 180 : 300);
  std::string script = page.Begin(terminal);
  int panel = 0;
  for (const PooledProblem& pool : pools) {
    for (int l = 0; l < levels; ++l) {
      script += page.Place(panel, {fmt::format("{}: {}", pool.name, kLevelTitles[l]),
                                   "Evaluations of the search", "Runs that hit (%)"});
      script += PoolPanel(pool, names, kPolishLevels[l], range, terminal);
      ++panel;
    }
  }
  return script + PanelPage::End();
}

}  // namespace lyrefit
