#include "lyrefit/report/compare_plot.h"

#include "lyrefit/base/file.h"
#include "lyrefit/report/compare_script.h"
#include "lyrefit/report/gnuplot.h"
#include "lyrefit/report/plot.h"

namespace lyrefit {
namespace {

using Script = std::string (*)(const Comparison& comparison, const std::string& terminal);

Expected<void> Draw(Script script, const Comparison& comparison, const std::string& path) {
  if (auto checked = CheckPlot(path); !checked) return checked;
  if (comparison.problems.empty()) return Fail("no problem was completed: nothing to draw", path);
  const char letter = path[path.size() - 3];
  const std::string terminal = letter == 's' || letter == 'S' ? "svg" : "png";
  const Expected<std::string> picture = RunGnuplot(script(comparison, terminal));
  if (!picture) return Fail(picture.error().message, path);
  return WriteTextFile(path, *picture);
}

}  // namespace

Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path) {
  return Draw(BoxScript, comparison, path);
}

Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path) {
  return Draw(ConvergenceScript, comparison, path);
}

Expected<void> PlotBudget(const Comparison& comparison, const std::string& path) {
  return Draw(BudgetScript, comparison, path);
}

}  // namespace lyrefit
