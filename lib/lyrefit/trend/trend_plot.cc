#include <fmt/format.h>

#include <cmath>

#include "lyrefit/curve/date_time.h"
#include "lyrefit/report/plots.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/trend/trend_documents.h"
#include "lyrefit/trend/trend_parts.h"
#include "lyrefit/trend/trend_report.h"
#include "lyrefit/trend/trend_words.h"

namespace lyrefit {
namespace {

constexpr double kMonth_days = 30.44;

double DaysSince(const TrendReport& report, double time_s) {
  return (time_s - report.first_s) / kDay_s;
}

// Ticks at the first day of months, at most nine of them.
Axis TimeAxis(const TrendReport& report) {
  Axis axis{""};
  const double days = DaysSince(report, report.last_s);
  axis.low = 0;
  axis.high = std::max(days, 1e-3);
  if (days < 3) {
    axis.label = "Days since " + DateTimeText(report.first_s);
    return axis;
  }
  axis.slanted = true;
  const double step = std::max(1.0, std::ceil(days / 8 / kMonth_days)) * kMonth_days;
  const bool short_series = days < 3 * kMonth_days;
  const double every = short_series ? std::max(1.0, std::ceil(days / 8)) : step;
  for (double day = 0; day <= days; day += every) {
    const std::string date = DateText(report.first_s + day * kDay_s);
    axis.ticks.push_back({short_series ? date.substr(5) : date.substr(0, 7), day});
  }
  return axis;
}

Panel QuantityPanel(const TrendReport& report, const TrendQuantity& quantity) {
  Panel panel{
      fmt::format("{} ({})", quantity.title, quantity.unit), TimeAxis(report), {quantity.unit}};
  panel.height = 220;
  Series points{SeriesKind::kPoints, {kGrey, 1, 7}, 1, 0.3};
  points.name = "a day";
  Series line{SeriesKind::kLine, {kVermilion, 1, 7}, 2};
  line.name = "regression";
  double last = kUnknown;
  for (const TrendDay& day : quantity.days) {
    const double x = DaysSince(report, day.time_s);
    points.Add(x, day.value);
    for (const TrendChange& change : quantity.changes) {
      const bool between = change.time_s > last && change.time_s <= day.time_s;
      if (!change.onset && between) line.EndLine();
    }
    line.Add(x, day.fitted);
    last = day.time_s;
  }
  for (const TrendChange& change : quantity.changes) {
    const double from = DaysSince(report, change.earliest_s);
    panel.bands.push_back(
        {true, from - 0.5, std::max(DaysSince(report, change.latest_s), from) + 0.5, kSkyBlue});
  }
  panel.series.push_back(std::move(points));
  panel.series.push_back(std::move(line));
  return panel;
}

// Daily losses, one part on the other, as medians of a week so that a picture shows them.
Panel LossPanel(const TrendReport& report, std::vector<LegendEntry>* legend) {
  Panel panel{
      "Loss against the reference, by part (% of the expected energy)", TimeAxis(report), {"%"}};
  panel.height = 260;
  panel.zero_line = true;
  for (std::size_t p = 0; p < report.loss_days.size(); ++p) {
    Series line{SeriesKind::kLine, LookOf(static_cast<int>(p)), 1.5};
    line.name = report.losses[p].name;
    for (const TrendDay& day : report.loss_days[p]) {
      line.Add(DaysSince(report, day.time_s), day.value);
    }
    legend->push_back({line.name, line.look, LegendMark::kLine});
    panel.series.push_back(std::move(line));
  }
  return panel;
}

}  // namespace

Figure TrendFigure(const TrendReport& report) {
  Figure figure;
  figure.title = report.name;
  figure.panels.push_back(LossPanel(report, &figure.legend));
  for (const TrendQuantity& quantity : report.quantities) {
    if (!quantity.days.empty()) figure.panels.push_back(QuantityPanel(report, quantity));
  }
  figure.columns = figure.panels.size() > 1 ? 2 : 1;
  figure.margin_below = 50;
  return figure;
}

Expected<void> PlotTrend(const TrendReport& report, const std::string& path, PlotPoints points) {
  return DrawFigure(TrendFigure(report), path, points);
}

block::Figure FigureBlock(const TrendReport& report) {
  block::Figure block;
  block.figure = TrendFigure(report);
  block.caption =
      "Above left: what each part takes, day by day. Else a point is a day at standard conditions, "
      "the "
      "line is the regression, a band the 95 % range of the day of a step or an onset.";
  return block;
}

}  // namespace lyrefit
