#include "lyrefit/report/data_sheet_text.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/version.h"
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

std::string ParameterSection(const DataSheetFit& fit) {
  TextTable table("llrl");
  table.Add({"parameter", "name", "value", fit.ranges.empty() ? "" : "within the rounding"});
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    const double value = fit.shared[i];
    table.Add({LabelWithUnit(info), info.name,
               std::isinf(value) ? "infinite" : Significant(value, kDataSheetDigits),
               Rounding(fit, info.name)});
  }
  std::string text = "Parameters at 1000 W/m2 and 25 C\n" + table.Text();
  if (fit.ranges.empty()) return text;
  return text +
         Wrap("  ",
              "within the rounding: how far a parameter moves while the printed values move, "
              "together, within half a unit of their last digits");
}

std::string CheckSection(const DataSheetFit& fit) {
  TextTable table("lrrrl");
  table.Add({"", "printed", "given", "difference", "unit"});
  for (const DataSheetCheck& check : fit.checks) {
    const double percent = 100 * (check.given / check.asked - 1);
    table.Add({check.name, Significant(check.asked, kDataSheetDigits),
               Significant(check.given, kDataSheetDigits),
               std::isfinite(percent) ? fmt::format("{:+.4f} %", percent) : "-", check.unit});
  }
  return "What the sheet prints and what the device gives\n" + table.Text() +
         Wrap("  ", fmt::format("Largest relative error of the five equations: {}",
                                Significant(fit.largest_relative_error, 2)));
}

}  // namespace

std::string DataSheetText(const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  std::string text =
      fmt::format("lyrefit {}: {} device by the law of De Soto behind a data sheet\n", Version(),
                  ModelTitle(spec.model));
  text +=
      Field("device", fmt::format("{} in series; constants {}",
                                  Plural(spec.cells_in_series, "cell"), ToText(spec.constants)));
  text += "\n" + ParameterSection(fit) + "\n" + CheckSection(fit);
  const std::string warnings = List("Warnings", fit.warnings);
  return text + (warnings.empty() ? "" : "\n") + warnings;
}

}  // namespace lyrefit
