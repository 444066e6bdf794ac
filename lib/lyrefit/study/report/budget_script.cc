#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "lyrefit/report/panels.h"
#include "lyrefit/study/report/compare_script.h"

namespace lyrefit {
namespace {

struct DrawnLevel {
  const char* title;
  Spread ContenderResult::*stage;
  int Spread::*hits;
};

constexpr std::array<DrawnLevel, 4> kDrawnLevels = {
    {{"search alone", &ContenderResult::searched, &Spread::within_1e6},
     {"one plain solve", &ContenderResult::plain_polished, &Spread::within_1e9},
     {"best bird's polish", &ContenderResult::own_polished, &Spread::within_1e9},
     {"all starts", &ContenderResult::polished, &Spread::within_1e9}}};

std::vector<std::string> Algorithms(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const ContenderResult& contender : problem.contenders) {
    if (std::find(names.begin(), names.end(), contender.algorithm) == names.end()) {
      names.push_back(contender.algorithm);
    }
  }
  return names;
}

// Lines that lie on each other are drawn one in the other, the first one widest.
std::string Panel(const ProblemResult& problem, const std::vector<std::string>& algorithms,
                  const DrawnLevel& level, const std::string& terminal) {
  std::string data, plot;
  double least = 1e300, most = 0;
  const int count = static_cast<int>(algorithms.size());
  const double step = std::min(1.8, 9.0 / count);
  for (int a = 0; a < count; ++a) {
    data += fmt::format("$a{} << END_OF_DATA\n", a);
    for (const ContenderResult& contender : problem.contenders) {
      if (contender.algorithm != algorithms[a]) continue;
      const double budget = static_cast<double>(contender.search.max_evaluations);
      least = std::min(least, budget);
      most = std::max(most, budget);
      const double share = 100.0 * ((contender.*level.stage).*level.hits) /
                           static_cast<double>(contender.runs.size());
      fmt::format_to(std::back_inserter(data), "{} {}\n", budget, share);
    }
    data += "END_OF_DATA\n";
    const double width = 1.3 + step * (count - 1 - a);
    plot += fmt::format("{} $a{} using 1:2 with linespoints lw {:.2f} pt {} ps {:.2f} {}",
                        a == 0 ? "plot" : ", \\\n", a, width, PointLook(a),
                        PointSize(terminal) * (1 + 0.15 * width), LineLook(a));
  }
  return data +
         fmt::format(
             "set logscale x\nset xrange [{:g}:{:g}]\nset format x '10^{{%T}}'\n"
             "set yrange [-4:104]\nset ytics 0,20\n",
             least / 1.6, most * 1.6) +
         plot + "\n";
}

}  // namespace

std::string BudgetScript(const Comparison& comparison, const std::string& terminal) {
  const std::vector<std::string> algorithms = Algorithms(comparison.problems[0]);
  const int levels = static_cast<int>(kDrawnLevels.size());
  const PanelPage page(
      static_cast<int>(comparison.problems.size()) * levels, levels,
      fmt::format("Share of {} runs that hit: within 1e-6 of the reference (search "
                  "alone) or 1e-9 (polished), {}; of equal lines the first is the widest",
                  comparison.options.runs, ToText(comparison.options.objective)),
      LegendMark::kLineAndPoint, algorithms, 0);
  const char* const models[] = {"SD", "DD", "TD"};
  std::string script = page.Begin(terminal);
  int panel = 0;
  for (const ProblemResult& problem : comparison.problems) {
    for (const DrawnLevel& level : kDrawnLevels) {
      const std::string title =
          fmt::format("{} {}: {}", problem.curve_name, models[static_cast<int>(problem.model) - 1],
                      level.title);
      script += page.Place(panel, {title, "Evaluations of the search", "Runs that hit (%)"});
      script += Panel(problem, algorithms, level, terminal);
      ++panel;
    }
  }
  return script + PanelPage::End();
}

}  // namespace lyrefit
