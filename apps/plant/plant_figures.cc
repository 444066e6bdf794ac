#include "plant/plant_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/median.h"
#include "lyrefit/batch/sparkline.h"
#include "lyrefit/report/text_layout.h"
#include "plant/plant_text.h"

namespace lyrefit {
namespace {

constexpr int kHistogramBins = 30;  // about
constexpr int kHistogramTicks = 5;
constexpr std::size_t kCurvesShown = 8;

// The round number above: 1, 2 or 5 times a power of ten.
double RoundStep(double step) {
  const double ten = std::pow(10, std::floor(std::log10(step)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * ten >= step * (1 - 1e-9)) return factor * ten;
  }
  return 10 * ten;
}

std::vector<double> SortedKnown(const std::vector<double>& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  std::sort(known.begin(), known.end());
  return known;
}

// Ends of an axis for all values, except distant ones that would compress all others. Values that
// are equal to rounding are widened.
std::array<double, 2> Ends(const std::vector<double>& sorted) {
  const double low = Quantile(sorted, 0.01);
  const double high = Quantile(sorted, 0.99);
  const double span = high - low;
  const double size = std::fmax(std::fabs(low), std::fabs(high));
  if (!(span > 1e-9 * size) || !(span > 1e-300)) {
    const double around = size > 0 ? 0.1 * size : 1;
    return {low - around, high + around};
  }
  return {std::fmax(sorted.front(), low - span), std::fmin(sorted.back(), high + span)};
}

// A histogram with the median, and in front of it that of the rows that differ. The outermost bars
// hold what lies beyond them too.
Panel Histogram(const PlantSample::Column& column, const std::vector<bool>& differs,
                const std::vector<double>& sorted) {
  const auto [low, high] = Ends(sorted);
  const double step = RoundStep((high - low) / kHistogramBins);
  const double first = std::floor(low / step + 1e-9);
  const auto bins = static_cast<std::size_t>(std::ceil(high / step - 1e-9) - first) + 1;
  std::vector<int> all(bins, 0), differing(bins, 0);
  for (std::size_t row = 0; row < column.values.size(); ++row) {
    if (!std::isfinite(column.values[row])) continue;
    const double place = std::floor(column.values[row] / step + 1e-9) - first;
    const auto bin =
        static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(bins - 1)));
    ++all[bin];
    if (!differs.empty() && differs[row]) ++differing[bin];
  }
  Panel panel;
  const std::string unit = column.unit.empty() ? "" : " (" + column.unit + ")";
  panel.x.label = ColumnInWords(column.name) + unit;
  panel.x.low = first * step;
  panel.x.high = (first + static_cast<double>(bins)) * step;
  panel.x.tick_step = RoundStep((panel.x.high - panel.x.low) / kHistogramTicks);
  panel.x.first_tick = std::ceil(panel.x.low / panel.x.tick_step - 1e-9) * panel.x.tick_step;
  panel.y.label = "Strings";
  panel.y.low = 0;
  panel.height = 170;
  const auto bars = [&](const std::vector<int>& counts, const char* colour, const char* what,
                        const std::string& flag) {
    Series series;
    series.filter_columns = {column.name, "status", "group_flag"};
    series.kind = SeriesKind::kBars;
    series.look.colour = colour;
    series.width = 0.92 * step;
    for (std::size_t b = 0; b < bins; ++b) {
      if (counts[b] == 0) continue;
      const double from = (first + static_cast<double>(b)) * step;
      series.Add(from + 0.5 * step, counts[b]);
      series.texts.push_back(
          fmt::format("{:.6g} to {:.6g}: {}{}", from, from + step, Counted(counts[b]), what));
      const std::string range = b == 0 ? fmt::format("<{:.10g}", from + step)
                                : b + 1 == bins
                                    ? fmt::format(">={:.10g}", from)
                                    : fmt::format("{:.10g}..<{:.10g}", from, from + step);
      series.filters.push_back({range, "=fine", flag});
    }
    panel.series.push_back(std::move(series));
  };
  bars(all, kSkyBlue, "", "");
  if (!differs.empty()) bars(differing, kVermilion, " that differ", "=true");
  Series median;
  median.look = {"#000000", 2};
  median.width = 1.5;
  for (const double y : {0.0, static_cast<double>(*std::max_element(all.begin(), all.end()))}) {
    median.Add(Quantile(sorted, 0.5), y);
  }
  panel.series.push_back(std::move(median));
  return panel;
}

// Adds a panel and a row of numbers for each column that is known of two strings or more.
void AddHistograms(const std::vector<PlantSample::Column>& columns,
                   const std::vector<bool>& differs, block::Figure* shown) {
  shown->readings = {
      "lrrrrrrrr",
      {{"value", "strings", "lowest", "5 %", "25 %", "median", "75 %", "95 %", "highest"}}};
  shown->readings.caption = "Quantiles of the strings whose number is known.";
  Figure& figure = shown->figure;
  for (const PlantSample::Column& column : columns) {
    const std::vector<double> sorted = SortedKnown(column.values);
    if (sorted.size() < 2) continue;
    figure.panels.push_back(Histogram(column, differs, sorted));
    block::Table::Row row = {figure.panels.back().x.label,
                             Counted(static_cast<std::int64_t>(sorted.size()))};
    for (const double share : {0.0, 0.05, 0.25, 0.5, 0.75, 0.95, 1.0}) {
      row.push_back(Significant(Quantile(sorted, share), 5));
    }
    shown->readings.rows.push_back(std::move(row));
  }
  figure.columns = 2;
  figure.panel_width = figure.panels.size() > 1 ? 340 : 0;
  figure.legend = {{"strings", {kSkyBlue}, LegendMark::kBar}};
  if (!differs.empty()) {
    figure.legend.push_back({"strings that differ", {kVermilion}, LegendMark::kBar});
  }
  figure.legend.push_back({"median", {"#000000", 2}, LegendMark::kLine});
}

std::string OfWhich(const PlantSummary& summary) {
  if (summary.fine <= static_cast<std::int64_t>(kPlantMostSampled)) return "";
  return fmt::format(" Of the {} strings {} are counted, chosen at random.", Counted(summary.fine),
                     Counted(kPlantMostSampled));
}

}  // namespace

block::Figure SpreadsFigure(const PlantSummary& summary) {
  block::Figure shown;
  AddHistograms(summary.sample.spreads, {}, &shown);
  shown.figure.title = "How many strings have which value";
  shown.caption =
      "Number of strings by value. The outermost bars also count the strings beyond the axis." +
      OfWhich(summary);
  return shown;
}

block::Figure NeighboursFigure(const PlantSummary& summary) {
  block::Figure shown;
  AddHistograms(summary.sample.neighbours, summary.sample.differs, &shown);
  shown.figure.title = "Deviation of each string from those of the same combiner";
  shown.caption =
      "Deviation from the median of the strings of the same combiner at like light. Strings "
      "that differ by more than is usual in the plant are counted apart. The outermost bars also "
      "count the strings beyond the axis." +
      OfWhich(summary);
  return shown;
}

block::Figure CurvesFigure(const PlantSummary& summary) {
  block::Figure shown;
  Panel panel;
  panel.x = {"Voltage, relative to Voc", 0, 1};
  panel.y = {"Current, relative to its largest", 0, 1.05};
  for (const PlantRow& row : summary.worst) {
    const std::vector<double> currents = ReadSparkline(row.sparkline);
    if (currents.empty() || panel.series.size() == kCurvesShown) continue;
    Series series;
    series.look = LookOf(static_cast<int>(panel.series.size()));
    series.width = 1.6;
    series.name = row.id;
    series.filter_columns = {"id"};
    series.filters = {{"=" + row.id}};
    for (int i = 0; i < kSparklinePoints; ++i) {
      series.Add(static_cast<double>(i) / (kSparklinePoints - 1), currents[i]);
    }
    shown.figure.legend.push_back({row.id, series.look, LegendMark::kLine});
    panel.series.push_back(std::move(series));
  }
  if (panel.series.empty()) return shown;
  shown.figure.title = "Curves of the worst strings";
  shown.caption = fmt::format(
      "The curves of the {} worst strings, by {}, each relative to its "
      "largest current and its open-circuit voltage.",
      panel.series.size(), ColumnInWords(summary.worst_by));
  shown.figure.panels.push_back(std::move(panel));
  return shown;
}

}  // namespace lyrefit
