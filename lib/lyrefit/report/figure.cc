#include "lyrefit/report/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "lyrefit/base/groups.h"
#include "lyrefit/report/figure_parts.h"

namespace lyrefit {
namespace {

std::string DataOf(const Panel& panel, const Series& series, const MostRows& most) {
  std::string data;
  bool first = true;
  for (const std::vector<FigureRow>& stretch : RowsToDraw(panel, series, most)) {
    if (!first) data += "\n";
    first = false;
    for (const auto& [x, y, colour] : stretch) {
      fmt::format_to(std::back_inserter(data), "{:.9g} {:.9g} {:.9g}\n", x, y, colour);
    }
  }
  return data;
}

std::string AxisCommands(const std::string& axis, const Axis& is, bool empty) {
  std::string script = fmt::format("{}set logscale {}\n", is.log ? "" : "un", axis);
  const bool bare = empty && std::isnan(is.high);
  const auto end = [&](double value, double where_empty) {
    if (std::isnan(value)) return bare ? fmt::format("{}", where_empty) : std::string("*");
    return is.log ? fmt::format("{:.6g}", value) : fmt::format("{}", value);
  };
  script += fmt::format("set {}range [{}:{}]\n", axis, end(is.low, is.log ? 1 : 0),
                        end(is.high, is.log ? 10 : 1));
  if (is.tight) script += fmt::format("set autoscale {}fix\n", axis);
  script += fmt::format("set format {}{}\n", axis, is.log ? " '10^{%T}'" : "");
  std::string ticks;
  for (const Tick& tick : is.ticks) {
    ticks +=
        fmt::format("{}{} {:.9g}", ticks.empty() ? "" : ", ", GnuplotText(tick.name), tick.place);
  }
  script += fmt::format(
      "set {}tics {} ", axis,
      // A word stands between the offset and a first tick below zero, which would be subtracted.
      is.slanted ? "rotate by 40 right offset 0.6,0.2 noenhanced"
                 : "norotate autojustify offset 0,0 enhanced");
  if (!ticks.empty()) return script + "(" + ticks + ")\n";
  if (std::isnan(is.tick_step)) return script + "autofreq\n";
  script += fmt::format("{:.6g}, {:.6g}\n", is.first_tick, is.tick_step);
  if (is.log) script += fmt::format("set m{}tics {}\n", axis, is.tick_step > 10 ? 1 : 10);
  return script;
}

// Bands and notes of a panel. Tags below 1000 belong to panels.
std::string BandsAndNotes(const Panel& panel) {
  std::string script;
  int tag = 1;
  for (const Band& band : panel.bands) {
    const char* const where = band.upright ? "from first {0}, graph 0 to first {1}, graph 1"
                                           : "from graph 0, first {0} to graph 1, first {1}";
    script += fmt::format(
        "set object {} rectangle {} fc rgb '{}' fs transparent solid {} noborder behind\n", tag++,
        fmt::format(fmt::runtime(where), band.low, band.high), band.colour, band.opacity);
  }
  tag = 101;
  for (const Note& note : panel.notes) {
    script += fmt::format("set label {} {} at graph {:.3f}, graph {} {} noenhanced tc rgb '{}'\n",
                          tag++, GnuplotText(note.text), note.x, note.y, note.side, note.colour);
  }
  return script;
}

std::string ColourOf(const Series& series) {
  return series.look.colour.empty() ? "palette" : fmt::format("rgb '{}'", series.look.colour);
}

// gnuplot's style of a series, after its data.
std::string Drawn(const Series& series, double point_size) {
  const Look& look = series.look;
  const std::string columns = look.colour.empty() ? "1:2:3" : "1:2";
  const std::string line = fmt::format("lw {:.2f} dt {}", series.width, look.dash);
  const std::string point = fmt::format("pt {} ps {:.2f}", look.point, point_size * series.size);
  const std::string colour = "lc " + ColourOf(series);
  switch (series.kind) {
    case SeriesKind::kPoints:
      return fmt::format("using {} with points {} lw {} {}", columns, point, series.width, colour);
    case SeriesKind::kLine:
      return fmt::format("using {} with lines {} {}", columns, line, colour);
    case SeriesKind::kLineAndPoints:
      return fmt::format("using {} with linespoints {} {} {}", columns, line, point, colour);
    case SeriesKind::kStems:
      return fmt::format("using {} with impulses {} {}", columns, line, colour);
    case SeriesKind::kBars:
      return fmt::format("using 1:2:({}) with boxes fs solid noborder {}", series.width, colour);
    case SeriesKind::kCells:
      return fmt::format("using 1:2:({}):({}){} with boxxyerror fs solid noborder {}",
                         0.5 * series.width, 0.5 * kCellHeight, look.colour.empty() ? ":3" : "",
                         colour);
    case SeriesKind::kBox:
      return fmt::format("using ({}):2:({}) with boxplot fs solid 0.45 {}", series.rows[0][0],
                         series.width, colour);
  }
  return "";
}

std::string PanelCommands(const Panel& panel, double point_size, const MostRows& rows) {
  constexpr char kOutliers[] =
      "set style boxplot range 1.5 outliers pointtype 6\nset pointsize 0.35\n";
  std::string data, plot, outliers;
  const auto join = [&plot](const std::string& what, bool right_axis, const std::string& title) {
    plot += fmt::format("{}{}{} {}", plot.empty() ? "plot " : ", \\\n ", what,
                        right_axis ? " axes x1y2" : "",
                        title.empty() ? "notitle" : "title " + GnuplotText(title) + " noenhanced");
  };
  for (const Rule& rule : panel.rules) {
    join(fmt::format("{} with lines lw {} dt {} lc rgb '{}'", rule.y, rule.width, rule.dash,
                     rule.colour),
         rule.right_axis, "");
  }
  for (std::size_t s = 0; s < panel.series.size(); ++s) {
    const Series& series = panel.series[s];
    if (series.rows.empty()) continue;
    if (series.kind == SeriesKind::kBox) outliers = kOutliers;
    data += fmt::format("$s{} << END_OF_DATA\n{}END_OF_DATA\n", s, DataOf(panel, series, rows));
    join(fmt::format("$s{} {}", s, Drawn(series, point_size)), series.right_axis, series.name);
  }
  const bool empty = plot.empty();
  std::string script = data + AxisCommands("x", panel.x, empty) + AxisCommands("y", panel.y, empty);
  script += panel.right ? AxisCommands("y2", *panel.right, empty) : "unset y2tics\n";
  script += fmt::format("set offsets graph {}, graph {}, graph {}, graph {}\n", panel.x.air_low,
                        panel.x.air_high, panel.y.air_high, panel.y.air_low);
  script +=
      panel.zero_line ? fmt::format("set xzeroaxis lc rgb '{}'\n", kGrey) : "unset xzeroaxis\n";
  return script + outliers + BandsAndNotes(panel) + (empty ? "plot NaN notitle" : plot) + "\n";
}

}  // namespace

void Series::Add(double x, double y, double colour) {
  if (std::isfinite(x) && std::isfinite(y) && std::isfinite(colour)) rows.push_back({x, y, colour});
}

Look LookOf(int index) {
  // Colours of Okabe and Ito without the yellow, plus a grey.
  constexpr std::array<const char*, 8> kColours = {kBlue,     kVermilion, "#009E73", "#CC79A7",
                                                   "#000000", kOrange,    kSkyBlue,  "#8C8C8C"};
  constexpr std::array<int, 8> kPoints = {7, 5, 9, 11, 6, 4, 8, 10};
  constexpr std::array<int, 4> kDashes = {1, 2, 4, 3};
  const std::size_t place = static_cast<std::size_t>(index) % kColours.size();
  const std::size_t round = static_cast<std::size_t>(index) / kColours.size();
  return {kColours[place], kDashes[round % kDashes.size()], kPoints[place]};
}

std::vector<LegendEntry> LegendOf(const std::vector<std::string>& names, LegendMark mark) {
  std::vector<LegendEntry> legend;
  legend.reserve(names.size());
  for (const std::string& name : names) {
    legend.push_back({name, LookOf(static_cast<int>(legend.size())), mark});
  }
  return legend;
}

void Series::EndLine() { ends.push_back(rows.size()); }

std::string FigureScript(const Figure& figure, const std::string& terminal, PlotPoints points) {
  const double point_size = terminal == "svg" ? 0.6 : 1;  // gnuplot draws larger symbols in SVG
  const MostRows rows = points == PlotPoints::kAll ? MostRows() : MostOf(figure);
  const PageLayout page = LayOut(figure);
  std::string script = PageCommands(figure, page, terminal);
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    script += PlacePanel(figure, page, static_cast<int>(p)) +
              PanelCommands(figure.panels[p], point_size, rows);
    if (p == 0) script += "unset colorbox\n";
  }
  return script + "unset multiplot\n";
}

namespace {

// Rows of a whole figure that make an SVG of one megabyte. A mark takes ten times the bytes of a
// corner of a line.
constexpr std::size_t kMostMarksDrawn = 3 * kMostMarks;
constexpr std::size_t kMostCorners = 4 * kMostMarks;

bool HasMarks(const Series& series) {
  return series.kind == SeriesKind::kPoints || series.kind == SeriesKind::kLineAndPoints;
}

// Largest length of each stretch for a total of at most `most`; short stretches are kept whole.
std::size_t ShareOf(std::size_t most, std::vector<std::size_t> sizes) {
  std::sort(sizes.begin(), sizes.end());
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const std::size_t each = most / (sizes.size() - i);
    if (sizes[i] > each) return each;
    most -= sizes[i];
  }
  return kAllRows;
}

// Thinned rows from `begin` to `end`. Distances in x are logarithmic on a logarithmic axis.
std::vector<FigureRow> Stretch(const Panel& panel, const Series& series, std::size_t begin,
                               std::size_t end, std::size_t most) {
  const auto at = [&series](std::size_t i) { return series.rows.begin() + static_cast<long>(i); };
  if (end - begin <= most) return {at(begin), at(end)};
  std::vector<double> x, y;
  for (std::size_t i = begin; i < end; ++i) {
    x.push_back(panel.x.log ? std::log(series.rows[i][0]) : series.rows[i][0]);
    y.push_back(series.rows[i][1]);
  }
  std::vector<FigureRow> rows;
  for (const std::size_t i : MarksToDraw(x, y, std::max<std::size_t>(most, 4))) {
    rows.push_back(series.rows[begin + i]);
  }
  return rows;
}

}  // namespace

MostRows MostOf(const Figure& figure) {
  std::vector<std::size_t> marks, corners;
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series) {
      std::vector<std::size_t>& sizes = HasMarks(series) ? marks : corners;
      std::size_t begin = 0;
      for (const std::size_t end : series.ends) {
        sizes.push_back(end - begin);
        begin = end;
      }
      sizes.push_back(series.rows.size() - begin);
    }
  }
  return {ShareOf(kMostMarksDrawn, std::move(marks)), ShareOf(kMostCorners, std::move(corners))};
}

std::vector<std::vector<FigureRow>> RowsToDraw(const Panel& panel, const Series& series,
                                               const MostRows& most) {
  std::size_t each = HasMarks(series) ? most.marks : most.corners;
  if (series.kind == SeriesKind::kStems) each = std::min(each, most.marks);  // drawn with marks
  const bool whole = series.kind == SeriesKind::kBox || series.kind == SeriesKind::kBars ||
                     series.kind == SeriesKind::kCells;
  if (whole) each = kAllRows;  // quartiles require all rows; a bar without its neighbours is a gap
  std::vector<std::vector<FigureRow>> stretches;
  std::size_t begin = 0;
  for (const std::size_t end : series.ends) {
    stretches.push_back(Stretch(panel, series, begin, end, each));
    begin = end;
  }
  stretches.push_back(Stretch(panel, series, begin, series.rows.size(), each));
  return stretches;
}

std::vector<std::size_t> MarksToDraw(const std::vector<double>& x, const std::vector<double>& y,
                                     std::size_t most) {
  const std::size_t count = std::min(x.size(), y.size());
  std::vector<std::size_t> places(count);
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (count <= most) return places;
  places.erase(
      std::remove_if(places.begin(), places.end(),
                     [&](std::size_t i) { return !std::isfinite(x[i]) || !std::isfinite(y[i]); }),
      places.end());
  if (places.size() <= most) return places;
  const auto by_x = [&x](std::size_t a, std::size_t b) { return x[a] < x[b]; };
  const auto [left, right] = std::minmax_element(places.begin(), places.end(), by_x);
  const double begin = x[*left];
  const double span = x[*right] - begin;
  const std::size_t last_bin = (most - 2) / 4;
  const auto last = static_cast<double>(last_bin);
  std::vector<double> bins;
  bins.reserve(places.size());
  for (const std::size_t i : places) {
    bins.push_back(span > 0 ? std::floor((x[i] - begin) / span * last) : 0);
  }
  std::vector<std::size_t> by_bin;
  GroupRule rule;
  for (const int k : RisingOrder(bins)) {
    by_bin.push_back(places[k]);
    rule.place.push_back(bins[k]);
  }
  const Grouping first = GroupByRule(static_cast<int>(by_bin.size()), rule);
  std::vector<std::size_t> kept = {places.front(), places.back()};
  const auto by_y = [&y](std::size_t a, std::size_t b) { return y[a] < y[b]; };
  // Four points for each bin: the lowest, the highest and two typical ones.
  for (int g = 0; g < GroupCount(first); ++g) {
    const auto from = by_bin.begin() + first[g], to = by_bin.begin() + first[g + 1];
    const auto [lowest, highest] = std::minmax_element(from, to, by_y);
    kept.insert(kept.end(), {*lowest, *highest, from[(to - from) / 3], from[2 * (to - from) / 3]});
  }
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  return kept;
}

}  // namespace lyrefit
