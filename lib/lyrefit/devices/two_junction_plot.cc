#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/two_junction_report.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/plots.h"

namespace lyrefit {
namespace {

constexpr int kJunctionModelPoints = 300;

Series ModelLine(const TwoJunctionReport& report, const TwoJunctionCurveReport& one,
                 const Look& look) {
  Series line{SeriesKind::kLine, look, 1.5};
  line.name = one.curve.name;
  const std::vector<double>& voltage = one.curve.voltage_V;
  const auto [low, high] = std::minmax_element(voltage.begin(), voltage.end());
  const double thermal_V = ThermalVoltage(report.temperature_K, report.constants);
  for (int k = 0; k < kJunctionModelPoints; ++k) {
    const double at = *low + (*high - *low) * k / (kJunctionModelPoints - 1);
    line.Add(at, TwoJunctionCurrent(thermal_V, one.parameters.data(), at));
  }
  return line;
}

}  // namespace

Figure TwoJunctionFigure(const TwoJunctionReport& report) {
  Figure figure;
  figure.title = fmt::format("{}, two junctions: RMSE {:.4g} A solved-current", report.name,
                             report.rmse.refined.solved_current_A);
  Panel curves{"Measured points and model", {"Voltage (V)"}, {"Current (A)"}};
  Panel residuals{"Residuals, solved-current", {"Voltage (V)"}, {"Model - measured (A)"}};
  curves.zero_line = residuals.zero_line = true;
  residuals.height = 200;
  std::vector<std::string> names;
  for (std::size_t c = 0; c < report.curves.size(); ++c) {
    const TwoJunctionCurveReport& one = report.curves[c];
    const Look look = LookOf(static_cast<int>(c));
    names.push_back(one.curve.name);
    Series points{SeriesKind::kPoints, look, 1, 0.7};
    Series misfit{SeriesKind::kLineAndPoints, look, 0.7, 0.5};
    points.name = misfit.name = one.curve.name;
    for (std::size_t k = 0; k < one.curve.size(); ++k) {
      points.Add(one.curve.voltage_V[k], one.curve.current_A[k]);
      misfit.Add(one.curve.voltage_V[k], one.model_A[k] - one.curve.current_A[k]);
    }
    curves.series.push_back(std::move(points));
    curves.series.push_back(ModelLine(report, one, look));
    residuals.series.push_back(std::move(misfit));
  }
  figure.legend = LegendOf(names, LegendMark::kLineAndPoint);
  figure.panels = {std::move(curves), std::move(residuals)};
  figure.panel_width = 684;
  return figure;
}

Expected<void> PlotTwoJunctions(const TwoJunctionReport& report, const std::string& path,
                                PlotPoints points) {
  return DrawFigure(TwoJunctionFigure(report), path, points);
}

}  // namespace lyrefit
