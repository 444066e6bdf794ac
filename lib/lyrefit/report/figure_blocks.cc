#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/certify/certify.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/record_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kReadingDigits = 6;
constexpr int kResidualDigits = 3;
constexpr std::size_t kMostReadings = 500;  // rows of a table for reading

// Indices of the readings that a table shows; the caption states where the others are.
std::vector<std::size_t> RowsShown(const std::vector<double>& voltage_V,
                                   const std::vector<double>& current_A, std::string* caption) {
  const std::size_t all = std::min(voltage_V.size(), current_A.size());
  std::vector<std::size_t> shown = MarksToDraw(voltage_V, current_A, kMostReadings);
  if (shown.size() < all) {
    *caption += fmt::format(" {} of {} readings; the others are in the data of the page.",
                            shown.size(), all);
  }
  return shown;
}

block::Table FitReadings(const FitReport& report) {
  const IvCurve& curve = report.curve;
  block::Table table = {
      "rrrrr",
      {{"voltage (V)", "measured (A)", "model (A)", "model - measured (A)", "measured (W)"}}};
  table.caption = "Readings, and the model's current at their voltages.";
  for (const std::size_t i : RowsShown(curve.voltage_V, curve.current_A, &table.caption)) {
    const double residual_A = i < report.residual_A.size() ? report.residual_A[i] : kUnknown;
    table.rows.push_back({Significant(curve.voltage_V[i], kReadingDigits),
                          Significant(curve.current_A[i], kReadingDigits),
                          Significant(curve.current_A[i] + residual_A, kReadingDigits),
                          Significant(residual_A, kResidualDigits),
                          Significant(curve.voltage_V[i] * curve.current_A[i], kReadingDigits)});
  }
  return table;
}

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

block::Figure FigureBlock(const FitReport& report) {
  block::Figure shown;
  if (report.curve.voltage_V.empty() || report.refined.empty()) return shown;
  shown.caption = fmt::format(
      "Measured current and power and the {} model over voltage; below, model minus measured "
      "current with a band of one solved-current RMSE either way. The largest error is {} A at {} "
      "V.",
      ModelTitle(report.model), Significant(report.residuals.largest_A, 3),
      Significant(report.residuals.largest_at_V, 4));
  shown.figure = FitFigure(report);
  shown.readings = FitReadings(report);
  return shown;
}

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

block::Figure FigureBlock(const Certificate& certificate) {
  block::Figure shown;
  if (certificate.floor.dual_A.empty()) return shown;
  shown.caption =
      "The proof of the floor: what a diode of each ideality could still gain. Nothing lies above "
      "zero, and zero is reached only at the diodes of the floor.";
  shown.figure = CertificateFigure(certificate);
  block::Table table = {"rrr", {{"diode", "n", "cosine of dual vector and column"}}};
  table.caption = "The diodes of the floor.";
  std::vector<double> n;
  for (const FloorDiode& diode : certificate.floor.diodes) n.push_back(diode.n);
  const std::vector<double> cosines = DualCosines(certificate, n);
  for (std::size_t i = 0; i < n.size(); ++i) {
    table.rows.push_back({std::to_string(i + 1), Significant(n[i], 8), Significant(cosines[i], 2)});
  }
  shown.readings = std::move(table);
  return shown;
}

block::Figure FigureBlock(const FamilyReport& report, const CurveSet& set) {
  block::Figure shown;
  if (report.curves.empty() || set.curves.empty()) return shown;
  shown.caption = fmt::format(
      "Measured points and model of up to twelve curves spread over the irradiances; beside them, "
      "over irradiance, {}. The colour is the cell temperature.",
      report.key_points ? "the errors of Pmp and Voc under each condition"
                        : "the RMSE of each curve and its mean residual");
  shown.figure = FamilyFigure(report, set);
  block::Table table = {"lrrrrr",
                        {{"curve", "irradiance (W/m2)", "temperature (C)", "points",
                          "solved-current RMSE (A)", "mean residual (A)"}}};
  table.caption = "The curves.";
  for (const FamilyCurve& curve : report.curves) {
    table.rows.push_back({curve.id, Significant(curve.irradiance_W_m2, 4),
                          Significant(curve.temperature_C, 4), std::to_string(curve.points),
                          Scientific(curve.rmse.solved_current_A, 3),
                          Significant(curve.mean_residual_A, kResidualDigits)});
  }
  shown.readings = std::move(table);
  return shown;
}

}  // namespace lyrefit
