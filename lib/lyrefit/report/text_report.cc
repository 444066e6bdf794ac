#include "lyrefit/report/text_report.h"

#include <fmt/format.h>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/report/text_sections.h"

namespace lyrefit {
namespace {

std::string Header(const FitReport& report) {
  std::string text =
      Banner(report.interrupted, report.usable, report.not_usable_because, report.doubts);
  text += fmt::format("lyrefit {}: {} model of {}\n", report.version, ModelTitle(report.model),
                      report.curve.name);
  text += CurveFields(report.curve);
  const std::string effects = EffectTitles(EffectsOf(report.device));
  if (!effects.empty()) text += Field("effects", effects);
  text += Field("objective", fmt::format("{}; bounds {}; constants {}", ToText(report.objective),
                                         report.bounds_name, ToText(report.constants)));
  return text;
}

}  // namespace

std::string FullReport(const FitReport& report) {
  std::string text = Header(report);
  for (const std::string& section :
       {ChoiceSection(report), FormSection(report), ParameterSection(report), ErrorSection(report),
        RmseSection(report), KeyPointSection(report), ResidualSection(report),
        SearchSection(report), List("Assumptions", SentencesOf(report.curve.assumptions)),
        List("Warnings", report.warnings)}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::string BriefReport(const FitReport& report) {
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  const std::string model = ToText(report.model) + PlusEffects(EffectsOf(report.device));
  std::string text = fmt::format(
      "{}: {}, RMSE {} A measured-current, {} A solved-current (fitted: {}{})", report.curve.name,
      model, Scientific(rmse.measured_current_A, 10), Scientific(rmse.solved_current_A, 10),
      ToText(report.objective), report.polished ? "" : ", not polished");
  for (const Estimate& e : report.estimates) {
    text += fmt::format(", {} {}{}{}", e.info.symbol,
                        Significant(report.polished ? e.refined : e.searched, 6),
                        e.info.unit.empty() ? "" : " ", e.info.unit);
  }
  text += BriefMarks(report.interrupted, report.usable, report.warnings.size(),
                     report.not_usable_because);
  return text + "\n";
}

}  // namespace lyrefit
