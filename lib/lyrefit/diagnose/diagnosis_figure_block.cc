#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

block::Table DiagnosisReadings(const Diagnosis& diagnosis) {
  const bool many = diagnosis.curves.size() > 1;
  const bool found = diagnosis.verdict.found;
  block::Table table = {many ? "lrrrr" : "rrrr", {}};
  block::Table::Row head = {"voltage (V)", "measured (A)", "base model (A)", "base - measured (A)"};
  if (many) head.insert(head.begin(), "curve");
  if (found) head.insert(head.end(), {"with causes (A)", "with causes - measured (A)"});
  table.heads = {head};
  table.alignment.resize(head.size(), 'r');
  table.caption = "Readings, and the models' currents at their voltages.";
  std::vector<double> voltage_V, current_A;
  for (const DiagnosedPoint& point : diagnosis.points) {
    voltage_V.push_back(point.voltage_V);
    current_A.push_back(point.current_A);
  }
  for (const std::size_t i : RowsShown(voltage_V, current_A, &table.caption)) {
    const DiagnosedPoint& point = diagnosis.points[i];
    block::Table::Row row = {Significant(point.voltage_V, kReadingDigits),
                             Significant(point.current_A, kReadingDigits),
                             Significant(point.before_A, kReadingDigits),
                             Significant(point.before_A - point.current_A, kResidualDigits)};
    if (many) row.insert(row.begin(), diagnosis.curves[static_cast<std::size_t>(point.curve)].name);
    if (found) {
      row.push_back(Significant(point.after_A, kReadingDigits));
      row.push_back(Significant(point.after_A - point.current_A, kResidualDigits));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// "irradiance step at 12.1 to 17.3 V"
std::string WhereCausesAct(const Diagnosis& diagnosis) {
  std::string text;
  for (const Cause& cause : diagnosis.verdict.causes) {
    double low = kUnknown, high = kUnknown;
    for (const int i : cause.points) {
      if (i < 0 || i >= static_cast<int>(diagnosis.points.size())) continue;
      const double at_V = diagnosis.points[static_cast<std::size_t>(i)].voltage_V;
      low = std::fmin(low, at_V);
      high = std::fmax(high, at_V);
    }
    if (!std::isfinite(low)) continue;
    text += fmt::format("{}{} most from {} to {} V", text.empty() ? "" : ", ", cause.title,
                        Significant(low, 3), Significant(high, 3));
  }
  return text;
}

}  // namespace

block::Figure FigureBlock(const Diagnosis& diagnosis) {
  block::Figure shown;
  if (diagnosis.points.empty()) return shown;
  shown.caption = fmt::format(
      "Measured points and the {} model over voltage; below, what the model leaves in % of Isc, "
      "with a band of what one diode misses of healthy modules.",
      diagnosis.base);
  const std::string where = WhereCausesAct(diagnosis);
  if (!where.empty()) shown.caption += " Marked is where a cause acts: " + where + ".";
  shown.figure = DiagnosisFigure(diagnosis);
  shown.readings = DiagnosisReadings(diagnosis);
  return shown;
}

}  // namespace lyrefit
