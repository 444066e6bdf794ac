#include "lyrefit/study/report/compare_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "lyrefit/report/panels.h"

namespace lyrefit {
namespace {

constexpr double kFloor = 1e-10;  // of the reference: closer than that is drawn as that

// A row of panels a curve, a column a model; curves side by side where there is only one model.
int Columns(const Comparison& comparison) {
  const int models = static_cast<int>(comparison.options.models.size());
  return models > 1 ? models : 3;
}

std::string PanelTitle(const ProblemResult& problem) {
  const char* const models[] = {"single diode", "double diode", "triple diode"};
  return problem.curve_name + ", " + models[static_cast<int>(problem.model) - 1];
}

std::vector<std::string> Names(const ProblemResult& problem) {
  std::vector<std::string> names;
  for (const ContenderResult& contender : problem.contenders) names.push_back(contender.name);
  return names;
}

// The range of positive numbers on a logarithmic axis.
struct LogRange {
  double low = 1e300;
  double high = 0;
  void Add(double value) {
    if (!(value > 0 && value < 1e300)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// With `air` on both sides, and a number at every decade, or every second where there are many.
std::string LogAxis(const char* axis, LogRange range, double air) {
  if (!(range.low <= range.high)) range = {1, 10};
  const double decades = std::log10(range.high / range.low);
  const int step = std::max(1, static_cast<int>(std::ceil(decades / 9)));
  const double first = std::pow(10.0, std::ceil(std::log10(range.low) - 1e-9));
  return fmt::format(
      "set logscale {0}\nset {0}range [{1:.6g}:{2:.6g}]\nset format {0} '10^{{%T}}'\n"
      "set {0}tics {3:.6g}, 1e{4}\nset m{0}tics {5}\n",
      axis, range.low / air, range.high * air, first, step, step == 1 ? 10 : 1);
}

double AboveReference(double rmse, const ProblemResult& problem) {
  return std::max(rmse - problem.reference.rmse_A, kFloor * problem.reference.rmse_A);
}

std::string ConvergencePanel(const Comparison& comparison, const ProblemResult& problem) {
  LogRange x, y;
  std::string data, plot;
  for (std::size_t c = 0; c < problem.contenders.size(); ++c) {
    data += fmt::format("$c{} << END_OF_DATA\n", c);
    for (const MedianPoint& point : problem.contenders[c].trace) {
      if (!(point.best_A < 1e300)) continue;
      const double above = AboveReference(point.best_A, problem);
      x.Add(static_cast<double>(point.evaluations));
      y.Add(above);
      fmt::format_to(std::back_inserter(data), "{} {}\n", point.evaluations, above);
    }
    data += "END_OF_DATA\n";
    plot +=
        fmt::format(", \\\n $c{} using 1:2 with lines lw 2 {}", c, LineLook(static_cast<int>(c)));
  }
  const double target = comparison.options.target_gap * problem.reference.rmse_A;
  y.Add(target);
  return data + LogAxis("x", x, 1.1) + LogAxis("y", y, 2) +
         fmt::format("plot {} with lines lw 1 lc rgb '#606060' dt 3{}\n", target, plot);
}

// Two boxes a contender; the data are clipped at the floor before gnuplot takes quartiles.
std::string BoxPanel(const Comparison& comparison, const ProblemResult& problem) {
  LogRange y;
  std::string data, plot, ticks;
  const int count = static_cast<int>(problem.contenders.size());
  for (int c = 0; c < count; ++c) {
    const ContenderResult& contender = problem.contenders[c];
    data += fmt::format("$c{} << END_OF_DATA\n", c);
    for (const RunRecord& run : contender.runs) {
      const double searched = AboveReference(run.searched_A, problem);
      const double polished =
          comparison.options.polish ? AboveReference(run.polished_A, problem) : searched;
      y.Add(searched);
      y.Add(polished);
      fmt::format_to(std::back_inserter(data), "{} {}\n", std::min(searched, 1e300),
                     std::min(polished, 1e300));
    }
    data += "END_OF_DATA\n";
    const double shift = comparison.options.polish ? 0.2 : 0;
    plot += fmt::format("{} $c{} using ({}):1:(0.32) with boxplot fs solid 0.45 lc rgb '{}'",
                        c == 0 ? "plot" : ", \\\n", c, c + 1 - shift, ColourOf(0));
    if (comparison.options.polish) {
      plot += fmt::format(", \\\n $c{} using ({}):2:(0.32) with boxplot fs solid 0.45 lc rgb '{}'",
                          c, c + 1 + shift, ColourOf(1));
    }
    ticks += fmt::format("{}{} {}", c == 0 ? "" : ", ", GnuplotText(contender.name), c + 1);
  }
  return data + "set style boxplot range 1.5 outliers pointtype 6\nset pointsize 0.35\n" +
         LogAxis("y", y, 3) +
         fmt::format(
             "set xrange [0.4:{}]\nset xtics ({}) rotate by 40 right noenhanced offset 0.6,0.2\n",
             count + 0.6, ticks) +
         plot + "\n";
}

std::string YAxis(const Comparison& comparison) {
  return fmt::format("RMSE above reference (A, {})", ToText(comparison.options.objective));
}

}  // namespace

std::string ConvergenceScript(const Comparison& comparison, const std::string& terminal) {
  const int count = static_cast<int>(comparison.problems.size());
  const PanelPage page(count, Columns(comparison),
                       fmt::format("Median of {} runs; dotted: target of {:g} above the reference",
                                   comparison.options.runs, comparison.options.target_gap),
                       LegendMark::kLine, Names(comparison.problems[0]), 0);
  std::string script = page.Begin(terminal);
  for (int p = 0; p < count; ++p) {
    script += page.Place(
        p, {PanelTitle(comparison.problems[p]), "Evaluations of the objective", YAxis(comparison)});
    script += ConvergencePanel(comparison, comparison.problems[p]);
  }
  return script + PanelPage::End();
}

std::string BoxScript(const Comparison& comparison, const std::string& terminal) {
  const int count = static_cast<int>(comparison.problems.size());
  std::vector<std::string> legend = {"search alone"};
  if (comparison.options.polish) legend.emplace_back("after the polish");
  std::size_t longest = 0;
  for (const std::string& name : Names(comparison.problems[0])) {
    longest = std::max(longest, name.size());
  }
  const PanelPage page(count, Columns(comparison),
                       fmt::format("{} runs each; lowest line: equal to the reference within {:g}",
                                   comparison.options.runs, kFloor),
                       LegendMark::kBox, legend, std::max(0, 6 * static_cast<int>(longest) - 30));
  std::string script = page.Begin(terminal);
  for (int p = 0; p < count; ++p) {
    script += page.Place(p, {PanelTitle(comparison.problems[p]), "", YAxis(comparison)});
    script += BoxPanel(comparison, comparison.problems[p]);
  }
  return script + PanelPage::End();
}

}  // namespace lyrefit
