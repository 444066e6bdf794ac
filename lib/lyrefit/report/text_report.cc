#include "lyrefit/report/text_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_sections.h"

namespace lyrefit {
namespace {

const char* ModelTitle(Model model) {
  switch (model) {
    case Model::kSingleDiode:
      return "single-diode";
    case Model::kDoubleDiode:
      return "double-diode";
    case Model::kTripleDiode:
      return "triple-diode";
  }
  return "?";
}

std::string Plural(int count, const char* noun, const char* nouns) {
  return fmt::format("{} {}", count, count == 1 ? noun : nouns);
}

std::string CurveText(const IvCurve& curve) {
  std::string text = curve.name;
  if (curve.size() > 0) {
    const auto [low, high] = std::minmax_element(curve.voltage_V.begin(), curve.voltage_V.end());
    text += fmt::format(", {} points from {:.6g} to {:.6g} V", curve.size(), *low, *high);
  }
  return curve.source.empty() ? text : text + fmt::format(" ({})", curve.source);
}

std::string ConditionsText(const Conditions& c) {
  return fmt::format("{:.6g} C, {:.6g} W/m2, {} in series, {} in parallel",
                     c.cell_temperature_K - kZeroCelsius_K, c.irradiance_W_m2,
                     Plural(c.cells_in_series, "cell", "cells"),
                     Plural(c.strings_in_parallel, "string", "strings"));
}

std::string Header(const FitReport& report) {
  std::string text;
  if (report.interrupted) {
    text += Wrap("", "INTERRUPTED: the best found so far; with more time the result may differ.") +
            "\n";
  }
  if (!report.usable) {
    text += Wrap("", "NOT USABLE: do not work with these values; see the warnings.") + "\n";
  }
  text += fmt::format("lyrefit {}: {} model of {}\n", report.version, ModelTitle(report.model),
                      report.curve.name);
  text += Field("curve", CurveText(report.curve));
  text += Field("conditions", ConditionsText(report.curve.conditions));
  text += Field("objective", fmt::format("{}; bounds {}; constants {}", ToText(report.objective),
                                         report.bounds_name, ToText(report.constants)));
  return text;
}

std::string List(const char* title, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return "";
  std::string text = std::string(title) + "\n";
  for (const std::string& sentence : sentences) text += Wrap("  - ", sentence);
  return text;
}

}  // namespace

std::string FullReport(const FitReport& report) {
  std::string text = Header(report);
  for (const std::string& section :
       {ChoiceSection(report), ParameterSection(report), RmseSection(report),
        KeyPointSection(report), ResidualSection(report), SearchSection(report),
        List("Assumptions", report.curve.assumptions), List("Warnings", report.warnings)}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::string BriefReport(const FitReport& report) {
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  std::string text =
      fmt::format("{}: {}, RMSE {} A measured-current, {} A solved-current (fitted: {}{})",
                  report.curve.name, ToText(report.model), Scientific(rmse.measured_current_A, 10),
                  Scientific(rmse.solved_current_A, 10), ToText(report.objective),
                  report.polished ? "" : ", not polished");
  for (std::size_t i = 0; i < report.estimates.size() && i < report.refined.size(); ++i) {
    const ParameterInfo& info = report.estimates[i].info;
    text += fmt::format(", {} {}{}{}", info.symbol, Significant(report.refined[i], 6),
                        info.unit.empty() ? "" : " ", info.unit);
  }
  if (report.interrupted) text += ", INTERRUPTED";
  if (!report.usable) text += ", NOT USABLE";
  if (!report.warnings.empty()) {
    text += fmt::format(", {}",
                        Plural(static_cast<int>(report.warnings.size()), "warning", "warnings"));
  }
  return text + "\n";
}

}  // namespace lyrefit
