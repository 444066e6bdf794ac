#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/base/numbers.h"
#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostReadings = 500;  // rows of a table for reading

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

}  // namespace

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

}  // namespace lyrefit
