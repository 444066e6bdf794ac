#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/translate/translation_parts.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {
namespace {

Series Drawn(const CurvePoints& points, SeriesKind kind, const Look& look,
             const std::string& name) {
  Series series;
  series.kind = kind;
  series.look = look;
  series.name = name;
  for (std::size_t i = 0; i < points.voltage_V.size(); ++i) {
    // Points outside the first quadrant are omitted: the device delivers no power there.
    if (points.voltage_V[i] < 0 || points.current_A[i] < 0) continue;
    series.Add(points.voltage_V[i], points.current_A[i]);
  }
  return series;
}

}  // namespace

Figure TranslationFigure(const TranslationReport& report) {
  Figure figure;
  figure.title = fmt::format("{} at {:g} W/m2, {:g} C", report.curve.name,
                             report.target.irradiance_W_m2, report.target.temperature_C);
  Panel panel;
  panel.x.label = "Voltage (V)";
  panel.y.label = "Current (A)";
  panel.x.low = panel.y.low = 0;
  const Look measured = {kGrey, 1, 7};
  figure.legend.push_back({"measured", measured, LegendMark::kPoint});
  panel.series.push_back(Drawn({report.curve.voltage_V, report.curve.current_A},
                               SeriesKind::kPoints, measured, "measured"));
  Series peaks;
  peaks.kind = SeriesKind::kPoints;
  peaks.size = 1.5;
  peaks.name = "maximum power";
  peaks.Add(report.source.max_power_voltage_V, report.source.max_power_current_A);
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const TranslatedResult& result = report.results[i];
    if (!result.computed()) continue;
    const bool best = static_cast<int>(i) == report.recommended;
    const Look look = LookOf(static_cast<int>(i));
    panel.series.push_back(Drawn(result.curve, SeriesKind::kLine, look, result.title));
    panel.series.back().width = best ? 2.5 : 1;
    figure.legend.push_back(
        {result.title + (best ? " (recommended)" : ""), look, LegendMark::kLine});
    peaks.Add(result.key_points.max_power_voltage_V, result.key_points.max_power_current_A);
  }
  double largest_V = 0;
  for (const Series& series : panel.series) {
    for (const auto& row : series.rows) largest_V = std::max(largest_V, row[0]);
  }
  panel.series.push_back(std::move(peaks));
  panel.x.high = 1.03 * largest_V;
  if (report.diagnosis) MarkCauses(*report.diagnosis, &panel);
  figure.panels.push_back(std::move(panel));
  return figure;
}

Expected<void> PlotTranslation(const TranslationReport& report, const std::string& path,
                               PlotPoints points) {
  return DrawFigure(TranslationFigure(report), path, points);
}

}  // namespace lyrefit
