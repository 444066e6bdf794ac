#include "lyrefit/study/report/compare_plot.h"

#include "lyrefit/study/report/compare_script.h"

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

}  // namespace lyrefit
