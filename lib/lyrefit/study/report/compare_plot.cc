#include "lyrefit/study/report/compare_plot.h"

#include "lyrefit/report/plot.h"
#include "lyrefit/study/report/compare_script.h"

namespace lyrefit {
namespace {

using ScriptWriter = std::string (*)(const Comparison& comparison, const std::string& terminal);

Expected<void> Draw(ScriptWriter script, const Comparison& comparison, const std::string& path) {
  if (comparison.problems.empty()) return Fail("no problem was completed: nothing to draw", path);
  return DrawScript([&](const std::string& terminal) { return script(comparison, terminal); },
                    path);
}

}  // namespace

Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path) {
  return Draw(BoxScript, comparison, path);
}

Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path) {
  return Draw(ConvergenceScript, comparison, path);
}

Expected<void> PlotBudget(const Comparison& comparison, const std::string& path) {
  const bool pooled = !comparison.problems.empty() && !comparison.problems[0].problem.empty();
  return Draw(pooled ? PoolScript : BudgetScript, comparison, path);
}

}  // namespace lyrefit
