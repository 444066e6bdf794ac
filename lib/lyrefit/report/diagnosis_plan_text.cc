#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/diagnosis_sections.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

// "97 %"
std::string WholePercent(double part) {
  return std::isfinite(part) ? fmt::format("{:.0f} %", 100 * part) : "-";
}

}  // namespace

std::string DiagnosisPlanSection(const Diagnosis& diagnosis) {
  if (!diagnosis.plan) return "";
  const Plan& plan = *diagnosis.plan;
  std::string text = "What would tell them apart\n" + Wrap("  ", FullSentence(plan.sentence));
  if (plan.measurements.empty()) return text;
  text += Field("between", fmt::format("{}", fmt::join(plan.causes, ", ")));
  TextTable table("lr" + std::string(plan.causes.size(), 'r'));
  std::vector<std::string> head = {"right name, besides these data", "mean"};
  for (const std::string& id : plan.causes) head.push_back("if " + id);
  table.Add(head);
  for (const PlannedMeasurement& measurement : plan.measurements) {
    std::vector<std::string> row = {measurement.id, WholePercent(measurement.probability)};
    for (const PlannedCause& cause : measurement.causes)
      row.push_back(WholePercent(cause.probability));
    table.Add(row);
  }
  text += table.Text();
  for (const PlannedMeasurement& measurement : plan.measurements) {
    text += Wrap("  - ",
                 fmt::format("{}: {}; {}.", measurement.id, measurement.title, measurement.taken));
  }
  return text + Wrap("  ",
                     "Simulated: each cause in turn is the true one, the readings it would "
                     "give are drawn, and all causes are fitted to old and new readings.");
}

}  // namespace lyrefit
