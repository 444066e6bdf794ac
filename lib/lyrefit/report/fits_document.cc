#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/version.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {

std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits) {
  const std::vector<Estimate>* largest = nullptr;
  for (const FittedFile& fit : fits) {
    if (!fit.report) continue;
    const bool larger = largest == nullptr || fit.report->estimates.size() > largest->size();
    if (larger) largest = &fit.report->estimates;
  }
  std::vector<ParameterInfo> parameters;
  if (largest == nullptr) return parameters;
  for (const Estimate& estimate : *largest) parameters.push_back(estimate.info);
  return parameters;
}

std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info) {
  const auto found = std::find_if(report.estimates.begin(), report.estimates.end(),
                                  [&](const Estimate& e) { return e.info.symbol == info.symbol; });
  if (found == report.estimates.end()) return {kUnknown, kUnknown};
  return {report.polished ? found->refined : found->searched, found->standard_error};
}

namespace {

block::Table::Row TextRow(const FittedFile& fit, const std::vector<ParameterInfo>& parameters) {
  const FitReport& report = *fit.report;
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  block::Table::Row row = {fit.file, ToText(report.model) + PlusEffects(EffectsOf(report.device)),
                           std::to_string(report.curve.size()),
                           Scientific(rmse.measured_current_A, 4),
                           Scientific(rmse.solved_current_A, 4)};
  for (const ParameterInfo& info : parameters) {
    row.push_back(Significant(ValueAndError(report, info).first, 5));
  }
  const std::string marks = BriefMarks(report.interrupted, report.usable, 0);
  row.push_back(report.polished ? marks.substr(marks.empty() ? 0 : 2) : "not polished" + marks);
  return row;
}

}  // namespace

Document FitsDocument(const std::vector<FittedFile>& fits) {
  const std::vector<ParameterInfo> parameters = LargestModel(fits);
  block::Table table = {"llrrr" + std::string(parameters.size(), 'r') + "l",
                        {{"", "", "", "RMSE (A)", "RMSE (A)"},
                         {"file", "model", "points", "measured-current", "solved-current"}}};
  for (const ParameterInfo& info : parameters) {
    table.heads[0].push_back(info.symbol);
    table.heads[1].push_back(info.unit);
  }
  std::vector<std::string> without;
  std::vector<std::string> warnings;
  for (const FittedFile& fit : fits) {
    if (!fit.report) {
      without.push_back(fmt::format("{}: {}", fit.file, fit.report.error().ToString()));
      continue;
    }
    table.rows.push_back(TextRow(fit, parameters));
    for (const std::string& warning : fit.report->warnings) {
      warnings.push_back(fmt::format("{}: {}", fit.file, warning));
    }
  }
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: fits of {}", Version(), Plural(fits.size(), "curve"));
  Section answers = {"Parameters"};
  if (!table.rows.empty()) AddTable(std::move(table), &answers);
  AddSections(
      {answers, ListSection("Not fitted", std::move(without)), WarningSection(std::move(warnings))},
      &document);
  return document;
}

}  // namespace lyrefit
