#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/study/report/compare_parts.h"
#include "lyrefit/study/report/documents.h"

namespace lyrefit {
namespace {

using FigureOf = Figure (*)(const Comparison& comparison);

Expected<void> Draw(FigureOf figure, const Comparison& comparison, const std::string& path) {
  if (comparison.problems.empty()) return Fail("no problem was completed: nothing to draw", path);
  return DrawFigure(figure(comparison), path);
}

}  // namespace

Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path) {
  return Draw(BoxFigure, comparison, path);
}

Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path) {
  return Draw(ConvergenceFigure, comparison, path);
}

namespace {

constexpr double kFloor = 1e-10;  // relative to the reference: smaller distances are drawn at it

// Number of panel columns: one for each model, and each row is a curve. With one model the curves
// are side by side.
int Columns(const Comparison& comparison) {
  const int models = static_cast<int>(comparison.options.models.size());
  return models > 1 ? models : 3;
}

std::string PanelTitle(const ProblemResult& problem) {
  const char* const models[] = {"single diode", "double diode", "triple diode"};
  return problem.curve_name + ", " + models[static_cast<int>(problem.model) - 1];
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

// An axis with the margin `air` at both ends. It has a label at every decade, or at every second
// one for wide ranges.
Axis LogAxis(const std::string& label, LogRange range, double air) {
  if (!(range.low <= range.high)) range = {1, 10};
  const double decades = std::log10(range.high / range.low);
  Axis axis{label, range.low / air, range.high * air};
  axis.log = true;
  axis.first_tick = std::pow(10.0, std::ceil(std::log10(range.low) - 1e-9));
  axis.tick_step = std::pow(10.0, std::max(1.0, std::ceil(decades / 9)));
  return axis;
}

double AboveReference(double rmse, const ProblemResult& problem) {
  return std::max(rmse - problem.reference.rmse_A, kFloor * problem.reference.rmse_A);
}

std::string HeightLabel(const Comparison& comparison) {
  return fmt::format("RMSE above reference (A, {})", ToText(comparison.options.objective));
}

Panel ConvergencePanel(const Comparison& comparison, const ProblemResult& problem) {
  Panel panel{PanelTitle(problem)};
  LogRange x, y;
  for (const AlgorithmResult& compared : problem.algorithms) {
    Series series{SeriesKind::kLine, LookOf(static_cast<int>(panel.series.size())), 2};
    series.name = compared.name;
    for (const MedianPoint& point : compared.trace) {
      if (!(point.best_A < 1e300)) continue;
      const auto evaluations = static_cast<double>(point.evaluations);
      const double above = AboveReference(point.best_A, problem);
      x.Add(evaluations);
      y.Add(above);
      series.Add(evaluations, above);
    }
    panel.series.push_back(std::move(series));
  }
  const double target = comparison.options.target_gap * problem.reference.rmse_A;
  y.Add(target);
  panel.rules = {{target, "#606060", 3}};
  panel.x = LogAxis("Evaluations of the objective", x, 1.1);
  panel.y = LogAxis(HeightLabel(comparison), y, 2);
  return panel;
}

// Two boxes for each algorithm. The data are clipped at kFloor before gnuplot computes quartiles.
Panel BoxPanel(const Comparison& comparison, const ProblemResult& problem) {
  const bool polish = comparison.options.polish;
  Panel panel{PanelTitle(problem)};
  LogRange y;
  const auto add_box = [&](const AlgorithmResult& compared, double x, double RunRecord::*end_A,
                           int colour) {
    Series box{SeriesKind::kBox, LookOf(colour), 0.32};
    box.name = compared.name;
    for (const RunRecord& run : compared.runs) {
      const double above = AboveReference(run.*end_A, problem);
      y.Add(above);
      box.Add(x, std::min(above, 1e300));
    }
    panel.series.push_back(std::move(box));
  };
  const double shift = polish ? 0.2 : 0;
  double place = 0;
  for (const AlgorithmResult& compared : problem.algorithms) {
    ++place;
    add_box(compared, place - shift, &RunRecord::searched_A, 0);
    if (polish) add_box(compared, place + shift, &RunRecord::polished_A, 1);
    panel.x.ticks.push_back({compared.name, place});
  }
  panel.x.slanted = true;
  panel.x.low = 0.4;
  panel.x.high = place + 0.6;
  panel.y = LogAxis(HeightLabel(comparison), y, 3);
  return panel;
}

}  // namespace

Figure ConvergenceFigure(const Comparison& comparison) {
  Figure figure{fmt::format("Median of {} runs; dotted: target of {:g} above the reference",
                            comparison.options.runs, comparison.options.target_gap),
                LegendOf(AlgorithmNames(comparison.problems[0]), LegendMark::kLine)};
  figure.columns = Columns(comparison);
  for (const ProblemResult& problem : comparison.problems) {
    figure.panels.push_back(ConvergencePanel(comparison, problem));
  }
  return figure;
}

Figure BoxFigure(const Comparison& comparison) {
  std::vector<std::string> legend = {"search alone"};
  if (comparison.options.polish) legend.emplace_back("after the polish");
  std::size_t longest = 0;
  for (const std::string& name : AlgorithmNames(comparison.problems[0])) {
    longest = std::max(longest, name.size());
  }
  Figure figure{fmt::format("{} runs each; lowest line: equal to the reference within {:g}",
                            comparison.options.runs, kFloor),
                LegendOf(legend, LegendMark::kBox)};
  figure.columns = Columns(comparison);
  figure.margin_below = std::max(0, 6 * static_cast<int>(longest) - 30);
  for (const ProblemResult& problem : comparison.problems) {
    figure.panels.push_back(BoxPanel(comparison, problem));
  }
  return figure;
}

}  // namespace lyrefit
