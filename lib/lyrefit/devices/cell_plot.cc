#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/devices/cell_parts.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

// Factor of currents and its unit: mA/cm2 with an area, A without.
double CurrentFactor(const CellReport& report) {
  return std::isfinite(report.area_cm2) ? 1000 / report.area_cm2 : 1;
}

std::string CurrentLabel(const CellReport& report) {
  return std::isfinite(report.area_cm2) ? "Current density (mA/cm2)" : "Current (A)";
}

// Readings of the lit sweeps, one look each.
Panel CurvePanel(const CellReport& report, std::vector<LegendEntry>* legend) {
  Panel panel{"Lit curves", {"Voltage (V)"}, {CurrentLabel(report)}};
  panel.zero_line = true;
  const double factor = CurrentFactor(report);
  double highest = 0, voc = 0;
  int index = 0;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kLit) continue;
    Series series{SeriesKind::kLineAndPoints, LookOf(index++), 1.5, 0.35};
    series.name = sweep.name;
    for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
      series.Add(sweep.voltage_V[k], sweep.current_A[k] * factor);
    }
    legend->push_back({sweep.name, series.look, LegendMark::kLineAndPoint});
    panel.series.push_back(std::move(series));
    highest = std::max(highest, sweep.key.short_circuit_current_A * factor);
    voc = std::max(voc, sweep.key.open_circuit_voltage_V);
  }
  if (highest > 0) {
    panel.y.low = -0.3 * highest;
    panel.y.high = 1.15 * highest;
  }
  if (voc > 0) {
    panel.x.low = -0.15 * voc;
    panel.x.high = 1.15 * voc;
  }
  return panel;
}

// Open-circuit voltages over light, and lines with the n of the junction.
Panel LightPanel(const CellReport& report) {
  Panel panel{"Voc (V) over light", {"Isc, or photocurrent (A)"}, {"Voc (V)"}};
  panel.x.log = true;
  int index = 0;
  for (const IdealityOverLight& over : report.over_light) {
    Series points{SeriesKind::kPoints, LookOf(index), 1, 0.8};
    points.name = over.source == SweepKind::kSunsVoc ? "Suns-Voc" : "light series";
    for (const VocPoint& point : over.points) points.Add(point.light_A, point.voc_V);
    Series line{SeriesKind::kLine, LookOf(index++), 1};
    const double n = over.junction.value;
    line.name =
        fmt::format("n = {}{}", Significant(n, 3), over.rises_to_low_light ? " (around Isc)" : "");
    // Through the brightest point, down to the darkest light.
    const VocPoint &top = over.points.back(), &bottom = over.points.front();
    const double thermal_V =
        report.cells_in_series * ThermalVoltage(report.temperature_C + kZeroCelsius_K);
    const double drop = n * thermal_V * std::log(top.light_A / bottom.light_A);
    line.Add(bottom.light_A, top.voc_V - drop);
    line.Add(top.light_A, top.voc_V);
    // Below the points, which rise to the right.
    panel.notes.push_back({points.name + ": " + line.name, line.look.colour, 0.97,
                           0.05 + 0.08 * (index - 1), "right"});
    panel.series.push_back(std::move(line));
    panel.series.push_back(std::move(points));
  }
  return panel;
}

// Currents of dark curves on a logarithmic axis.
Panel DarkPanel(const CellReport& report) {
  Panel panel{"Dark curve", {"Voltage (V)"}, {CurrentLabel(report)}};
  panel.y.log = true;
  int index = 0;
  for (const CellSweep& sweep : report.sweeps) {
    if (sweep.kind != SweepKind::kDark) continue;
    Series series{SeriesKind::kLineAndPoints, LookOf(index++), 1.5, 0.35};
    series.name = sweep.name;
    for (std::size_t k = 0; k < sweep.voltage_V.size(); ++k) {
      const double forward = -sweep.current_A[k];
      if (sweep.voltage_V[k] > 0 && forward > 0) {
        series.Add(sweep.voltage_V[k], forward * CurrentFactor(report));
      }
    }
    panel.series.push_back(std::move(series));
  }
  return panel;
}

// Gap and index by power of the pairs over their rates.
Panel RatePanel(const CellReport& report) {
  Panel panel{"Hysteresis over the rate", {"Rate (V/s)"}, {"% (gap: of Jsc)"}};
  panel.x.log = true;
  panel.zero_line = true;
  Series gap{SeriesKind::kLineAndPoints, LookOf(0), 1.5, 0.8};
  Series index{SeriesKind::kLineAndPoints, LookOf(1), 1.5, 0.8};
  gap.name = "gap";
  index.name = "index by power";
  for (const int i : report.over_rate->pairs) {
    const DirectionPair& pair = report.pairs[i];
    const double rate = report.sweeps[pair.forward].scan_rate_V_s;
    gap.Add(rate, pair.gap_percent);
    index.Add(rate, 100 * pair.index_power);
  }
  for (const Series* series : {&gap, &index}) {
    panel.notes.push_back(
        {series->name, series->look.colour, 0.97, series == &gap ? 0.95 : 0.87, "right"});
  }
  panel.series = {std::move(gap), std::move(index)};
  return panel;
}

// Voc, FF and power of the direction of the main sweep over hours.
Panel HourPanel(const CellReport& report, const std::vector<HourRow>& rows) {
  Panel panel{"Over hours", {"Hours"}, {"% of the first sweep"}};
  const std::pair<const char*, double HourRow::*> quantities[] = {{"Voc", &HourRow::voc},
                                                                  {"Jsc", &HourRow::isc},
                                                                  {"FF", &HourRow::ff},
                                                                  {"Pmp", &HourRow::power}};
  int index = 0;
  for (const auto& [name, quantity] : quantities) {
    Series series{SeriesKind::kLineAndPoints, LookOf(index), 1.5, 0.8};
    series.name = name;
    for (const HourRow& row : rows) {
      if (report.sweeps[row.sweep].direction != report.sweeps[report.main].direction) continue;
      series.Add(row.hours, 100 * (row.*quantity));
    }
    panel.notes.push_back({name, series.look.colour, 0.03, 0.05 + 0.08 * index++, "left"});
    panel.series.push_back(std::move(series));
  }
  return panel;
}

// The fill factor from the ideal diode down to the measured one, each step a bar between its ends.
Panel WaterfallPanel(const CellReport& report, const FillFactorLosses& losses) {
  Panel panel{"Fill factor (%), " + report.sweeps[losses.sweep].name, {""}, {"Fill factor (%)"}};
  const std::vector<std::string> names = {"n = 1",  "recombination", "shunt",
                                          "series", "rest",          "measured"};
  std::vector<double> from = {0}, to = {100 * losses.ideal};
  double left = losses.ideal;
  for (const FillFactorPart& part : losses.parts) {
    from.push_back(100 * left);
    left -= part.loss.value;
    to.push_back(100 * left);
  }
  from.push_back(0);
  to.push_back(100 * left);
  const double lowest = *std::min_element(to.begin() + 1, to.end());
  panel.y.low = std::max(0.0, 5 * std::floor((lowest - 5) / 5));
  constexpr double kHalf = 0.35;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double x = static_cast<double>(k) + 1;
    const bool total = k == 0 || k + 1 == names.size();
    const double start = total ? panel.y.low : from[k];
    Series bar{SeriesKind::kLine, {total ? kBlue : kVermilion, 1, 7}, 3};
    bar.name = names[k];
    for (const auto& [dx, y] :
         {std::pair(-kHalf, start), std::pair(-kHalf, to[k]), std::pair(kHalf, to[k]),
          std::pair(kHalf, start), std::pair(-kHalf, start), std::pair(-kHalf, to[k])}) {
      bar.Add(x + dx, y);
    }
    panel.series.push_back(std::move(bar));
    panel.x.ticks.push_back({names[k], x});
    if (total) continue;
    const Ranged& loss = losses.parts[k - 1].loss;
    if (!std::isfinite(loss.low_95)) continue;
    Series whisker{SeriesKind::kLine, {kGrey, 1, 7}, 2};
    whisker.Add(x, from[k] - 100 * loss.low_95);
    whisker.Add(x, from[k] - 100 * loss.high_95);
    panel.series.push_back(std::move(whisker));
  }
  panel.x.low = 0.4;
  panel.x.high = static_cast<double>(names.size()) + 0.6;
  panel.x.slanted = true;
  panel.y.high = 100 * losses.ideal + 3;
  return panel;
}

}  // namespace

Figure CellFigure(const CellReport& report) {
  Figure figure;
  figure.title = report.name;
  if (report.main != -1) figure.panels.push_back(CurvePanel(report, &figure.legend));
  if (report.over_rate) figure.panels.push_back(RatePanel(report));
  const std::vector<HourRow> hours = RowsOfHours(report);
  if (report.main != -1 && !hours.empty()) figure.panels.push_back(HourPanel(report, hours));
  if (!report.over_light.empty()) figure.panels.push_back(LightPanel(report));
  if (report.dark) figure.panels.push_back(DarkPanel(report));
  for (const FillFactorLosses& losses : report.losses) {
    if (losses.missing.empty()) figure.panels.push_back(WaterfallPanel(report, losses));
  }
  figure.columns = figure.panels.size() > 1 ? 2 : 1;
  figure.margin_below = 40;
  return figure;
}

Expected<void> PlotCell(const CellReport& report, const std::string& path, PlotPoints points) {
  return DrawFigure(CellFigure(report), path, points);
}

block::Figure FigureBlock(const CellReport& report) {
  block::Figure block;
  block.figure = CellFigure(report);
  std::vector<std::string> shown;
  if (report.main != -1) shown.emplace_back("lit curves");
  if (report.over_rate) shown.emplace_back("hysteresis over the rate");
  if (report.main != -1 && !RowsOfHours(report).empty()) {
    shown.emplace_back("key points over hours, of the first sweep");
  }
  if (!report.over_light.empty()) {
    shown.emplace_back("open-circuit voltages over light with lines of the junction's n");
  }
  if (report.dark) shown.emplace_back("dark curve");
  if (std::any_of(report.losses.begin(), report.losses.end(),
                  [](const FillFactorLosses& losses) { return losses.missing.empty(); })) {
    shown.emplace_back(
        "fill factor from the ideal diode to the measured one, with 95 % intervals of each loss");
  }
  block.caption = fmt::format("From the upper left: {}.", fmt::join(shown, "; "));
  return block;
}

}  // namespace lyrefit
