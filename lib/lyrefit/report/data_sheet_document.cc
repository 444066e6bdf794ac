#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/version.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/report/documents.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kDataSheetDigits = 6;

std::string Rounding(const DataSheetFit& fit, const std::string& name) {
  for (const DataSheetRange& range : fit.ranges) {
    if (range.name == name) return Range(range.low, range.high);
  }
  return fit.ranges.empty() ? "" : "held";
}

Section SheetParameterSection(const DataSheetFit& fit) {
  block::Table table = {
      "llrl", {{"parameter", "name", "value", fit.ranges.empty() ? "" : "within the rounding"}}};
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    const double value = fit.shared[i];
    table.rows.push_back({LabelWithUnit(info), info.name,
                          std::isinf(value) ? "infinite" : Significant(value, kDataSheetDigits),
                          Rounding(fit, info.name)});
  }
  Section section = {"Parameters at 1000 W/m2 and 25 C"};
  AddTable(std::move(table), &section);
  if (fit.ranges.empty()) return section;
  AddSentence(
      "within the rounding: how far a parameter moves while the printed values move, together, "
      "within half a unit of their last digits",
      &section);
  return section;
}

Section CheckSection(const DataSheetFit& fit) {
  block::Table table = {"lrrrl", {{"", "printed", "given", "difference", "unit"}}};
  for (const DataSheetCheck& check : fit.checks) {
    const double percent = 100 * (check.given / check.asked - 1);
    table.rows.push_back({check.name, Significant(check.asked, kDataSheetDigits),
                          Significant(check.given, kDataSheetDigits),
                          std::isfinite(percent) ? fmt::format("{:+.4f} %", percent) : "-",
                          check.unit});
  }
  Section section = {"What the sheet prints and what the device gives"};
  AddTable(std::move(table), &section);
  AddSentence(fmt::format("Largest relative error of the five equations: {}",
                          Significant(fit.largest_relative_error, 2)),
              &section);
  return section;
}

}  // namespace

Document DataSheetDocument(const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  Document document;
  document.head.heading =
      fmt::format("lyrefit {}: {} device by the law of De Soto behind a data sheet", Version(),
                  ModelTitle(spec.model));
  AddField("device",
           fmt::format("{} in series; constants {}", Plural(spec.cells_in_series, "cell"),
                       ToText(spec.constants)),
           &document.head);
  AddSections({SheetParameterSection(fit), CheckSection(fit), WarningSection(fit.warnings)},
              &document);
  return document;
}

std::string DataSheetText(const DataSheetFit& fit) { return DrawText(DataSheetDocument(fit)); }

}  // namespace lyrefit
