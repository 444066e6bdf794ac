#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "lyrefit/report/figure_parts.h"

namespace lyrefit {
namespace {

using Json = nlohmann::ordered_json;

// Plotly's names of gnuplot's symbols, from number 1.
constexpr std::array<const char*, 13> kSymbols = {
    "cross-thin-open", "x-thin-open",  "asterisk-open",    "square-open", "square",
    "circle-open",     "circle",       "triangle-up-open", "triangle-up", "triangle-down-open",
    "triangle-down",   "diamond-open", "diamond"};
constexpr std::array<const char*, 5> kDashes = {"solid", "dash", "dot", "dashdot", "longdashdot"};
constexpr std::array<const char*, 3> kBarColours = {kBlue, "#8C8C8C", kVermilion};

std::string SymbolOf(const Look& look) {
  const auto place = static_cast<std::size_t>(std::max(1, look.point) - 1);
  return kSymbols[place % kSymbols.size()];
}

// The unit in an axis label: "mA" of "Current (mA)"; empty without a unit.
std::string UnitOf(const std::string& label) {
  const std::size_t open = label.rfind('(');
  if (open == std::string::npos || label.back() != ')') return "";
  return label.substr(open + 1, label.size() - open - 2);
}

std::string WithUnit(const char* value, const Axis& axis) {
  const std::string unit = axis.ticks.empty() ? UnitOf(axis.label) : "";
  if (unit.empty()) return value;
  return value + std::string(" ") + PlotlyText(unit);
}

std::string HoverText(const Panel& panel, const Axis& y, const std::string& name) {
  return WithUnit("%{x:.5~g}", panel.x) + "<br>" + WithUnit("%{y:.5~g}", y) + "<extra>" +
         PlotlyText(name) + "</extra>";
}

// The legend entry with the look of a series; empty if there is none.
std::string EntryOf(const Figure& figure, const Series& series) {
  const bool marks = series.kind == SeriesKind::kPoints;
  std::string name;
  for (const LegendEntry& entry : figure.legend) {
    if (entry.look.colour != series.look.colour) continue;
    const bool same = (entry.mark == LegendMark::kPoint) == marks;
    if (same || name.empty()) name = entry.name;
    if (same) break;
  }
  return name;
}

// The colour of a value, interpolated between the colours of the bar.
std::string BarColour(const ColourBar& bar, double value) {
  const double share =
      bar.high > bar.low ? std::clamp((value - bar.low) / (bar.high - bar.low), 0.0, 1.0) : 0.5;
  const int step = share < 0.5 ? 0 : 1;
  const auto part = [](const char* colour, int i) {
    const std::string two(colour + 1 + 2 * i, 2);
    return static_cast<double>(std::strtol(two.c_str(), nullptr, 16));
  };
  std::string mixed = "#";
  for (int i = 0; i < 3; ++i) {
    const double from = part(kBarColours[step], i);
    const double to = part(kBarColours[step + 1], i);
    mixed += fmt::format("{:02x}", std::lround(from + (to - from) * (2 * share - step)));
  }
  return mixed;
}

Json LineOf(const Look& look, double width, const std::string& colour) {
  return {
      {"color", colour}, {"width", width}, {"dash", PlotlyDash(look.dash)}, {"simplify", false}};
}

Json MarkerOf(const Look& look, double size, const Json& colour) {
  const std::string symbol = SymbolOf(look);
  Json marker = {
      {"color", colour}, {"symbol", symbol}, {"size", std::round(10 * (3 + 5 * size)) / 10}};
  if (symbol.find("open") != std::string::npos) marker["line"] = {{"width", 1.3}};
  return marker;
}

// A trace without points: axes, hover text and legend group.
Json EmptyTrace(const Figure& figure, const Panel& panel, const Series& series,
                const PlotlyAxes& axes) {
  const std::string name = series.name.empty() ? EntryOf(figure, series) : series.name;
  const Axis& y = series.right_axis && panel.right ? *panel.right : panel.y;
  Json trace = {{"type", "scatter"},
                {"xaxis", axes.x},
                {"yaxis", series.right_axis ? axes.right : axes.y},
                {"name", PlotlyText(name)},
                {"legendgroup", PlotlyText(EntryOf(figure, series))},
                {"showlegend", false},
                {"hovertemplate", HoverText(panel, y, name)},
                {"x", Json::array()},
                {"y", Json::array()}};
  if (!series.filters.empty()) {
    trace["meta"] = series.filter_columns;
    trace["customdata"] = series.filters;
  }
  return trace;
}

void Append(const Json& x, const Json& y, Json* trace) {
  (*trace)["x"].push_back(x);
  (*trace)["y"].push_back(y);
}

// Quantile interpolated between rows, as in gnuplot's boxes.
double Quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

void AddBox(const Series& series, const Json& empty, Json* data) {
  std::vector<double> y;
  for (const FigureRow& row : series.rows) y.push_back(row[1]);
  std::sort(y.begin(), y.end());
  const double x = series.rows.front()[0];
  const double half = 0.5 * series.width;
  const double low = Quantile(y, 0.25);
  const double high = Quantile(y, 0.75);
  const double reach = 1.5 * (high - low);
  const double bottom = *std::lower_bound(y.begin(), y.end(), low - reach);
  const double top = *std::prev(std::upper_bound(y.begin(), y.end(), high + reach));
  const std::string& colour = series.look.colour;
  Json box = empty;
  box["mode"] = "lines";
  box["line"] = LineOf({}, 1.2, colour);
  box["hoverinfo"] = "skip";
  box.erase("hovertemplate");
  for (const auto& [dx, at] : std::array<std::pair<double, double>, 5>{
           {{-half, low}, {half, low}, {half, high}, {-half, high}, {-half, low}}}) {
    Append(x + dx, at, &box);
  }
  const double middle = Quantile(y, 0.5);
  Append(nullptr, nullptr, &box);
  Append(x - half, middle, &box);
  Append(x + half, middle, &box);
  for (const auto& [from, to] : {std::pair(low, bottom), std::pair(high, top)}) {
    Append(nullptr, nullptr, &box);
    Append(x, from, &box);
    Append(x, to, &box);
  }
  data->push_back(box);
  Json marks = empty;  // hover values of the box, and every outlier
  marks["mode"] = "markers";
  marks["marker"] = {{"color", colour}, {"symbol", Json::array()}, {"size", 5}};
  const auto mark = [&](double at, const char* symbol) {
    Append(x, at, &marks);
    marks["marker"]["symbol"].push_back(symbol);
  };
  for (const double at : {bottom, low, middle, high, top}) mark(at, "line-ew-open");
  for (const double at : y) {
    if (at < bottom || at > top) mark(at, "circle-open");
  }
  data->push_back(marks);
}

// Bars from zero, or cells, which are bars from a base.
void AddBars(const Figure& figure, const Series& series, const Json& empty, Json* data) {
  const bool cells = series.kind == SeriesKind::kCells;
  Json trace = empty;
  trace["type"] = "bar";
  trace["width"] = series.width;
  Json colours = Json::array();
  for (const FigureRow& row : series.rows) {
    Append(row[0], cells ? kCellHeight : row[1], &trace);
    if (cells) trace["base"].push_back(row[1] - 0.5 * kCellHeight);
    colours.push_back(BarColour(figure.colour_bar.value_or(ColourBar()), row[2]));
  }
  trace["marker"] = {{"color", series.look.colour.empty() ? colours : Json(series.look.colour)},
                     {"line", {{"width", 0}}}};
  if (series.texts.size() == series.rows.size()) {
    for (const std::string& text : series.texts) trace["hovertext"].push_back(PlotlyText(text));
    trace["hovertemplate"] = "%{hovertext}<extra></extra>";
  }
  data->push_back(trace);
}

void AddSeries(const Figure& figure, const Panel& panel, const Series& series, const Json& empty,
               const MostRows& most, Json* data) {
  const Look& look = series.look;
  const bool by_row = look.colour.empty();
  const bool lines = series.kind != SeriesKind::kPoints;
  const bool marks =
      series.kind == SeriesKind::kPoints || series.kind == SeriesKind::kLineAndPoints;
  const ColourBar bar = figure.colour_bar.value_or(ColourBar());
  Json trace = empty;
  const auto finish = [&](const std::string& colour) {
    if (trace["x"].empty()) return;
    trace["mode"] = lines && marks ? "lines+markers" : lines ? "lines" : "markers";
    if (lines) trace["line"] = LineOf(look, series.width, colour);
    if (marks) trace["marker"] = MarkerOf(look, series.size, colour);
    if (!lines) trace["cliponaxis"] = false;  // draws whole symbols at the edge
    data->push_back(trace);
    trace = empty;
  };
  Json colours = Json::array();
  for (const std::vector<FigureRow>& stretch : RowsToDraw(panel, series, most)) {
    if (stretch.empty()) continue;
    if (lines && !trace["x"].empty()) Append(nullptr, nullptr, &trace);
    for (const FigureRow& row : stretch) {
      if (series.kind == SeriesKind::kStems) Append(row[0], 0, &trace);
      Append(row[0], row[1], &trace);
      if (series.kind == SeriesKind::kStems) Append(nullptr, nullptr, &trace);
      colours.push_back(BarColour(bar, row[2]));
    }
    if (by_row && lines) finish(BarColour(bar, stretch.front()[2]));  // a line has a single colour
  }
  if (by_row && !trace["x"].empty()) {
    trace["mode"] = "markers";
    trace["marker"] = MarkerOf(look, series.size, colours);
    data->push_back(trace);
  } else {
    finish(look.colour);
  }
}

}  // namespace

std::string PlotlyText(const std::string& text) {
  std::string plain;
  for (const char c : text) {
    switch (c) {
      case '&':
        plain += "&amp;";
        break;
      case '<':
        plain += "&lt;";
        break;
      case '>':
        plain += "&gt;";
        break;
      case '{':  // of %{...}, which Plotly would replace by a value
        plain += "&#123;";
        break;
      default:
        plain += static_cast<unsigned char>(c) < 32 ? ' ' : c;
    }
  }
  return plain;
}

std::string PlotlyDash(int dash) {
  return kDashes[static_cast<std::size_t>(std::max(1, dash) - 1) % kDashes.size()];
}

Json PlotlyLegend(const Figure& figure) {
  Json data = Json::array();
  for (const LegendEntry& entry : figure.legend) {
    const bool box = entry.mark == LegendMark::kBox || entry.mark == LegendMark::kBar;
    const bool point = entry.mark == LegendMark::kPoint;
    Json trace = {{"type", "scatter"},
                  {"x", Json::array({nullptr})},
                  {"y", Json::array({nullptr})},
                  {"name", PlotlyText(entry.name)},
                  {"legendgroup", PlotlyText(entry.name)},
                  {"hoverinfo", "skip"}};
    trace["mode"] = box || point                              ? "markers"
                    : entry.mark == LegendMark::kLineAndPoint ? "lines+markers"
                                                              : "lines";
    if (!box && !point) trace["line"] = LineOf(entry.look, 2, entry.look.colour);
    if (box) trace["marker"] = {{"color", entry.look.colour}, {"symbol", "square"}, {"size", 11}};
    if (!box) trace["marker"] = MarkerOf(entry.look, 1, entry.look.colour);
    data.push_back(trace);
  }
  return data;
}

void AddPlotlyTraces(const Figure& figure, const Panel& panel, const PlotlyAxes& axes,
                     const MostRows& most, Json* data) {
  bool on_the_right = false;
  for (const Series& series : panel.series) {
    on_the_right = on_the_right || (series.right_axis && !series.rows.empty());
    if (series.rows.empty()) continue;
    const Json empty = EmptyTrace(figure, panel, series, axes);
    if (series.kind == SeriesKind::kBox) {
      AddBox(series, empty, data);
    } else if (series.kind == SeriesKind::kBars || series.kind == SeriesKind::kCells) {
      AddBars(figure, series, empty, data);
    } else {
      AddSeries(figure, panel, series, empty, most, data);
    }
  }
  if (!panel.right || on_the_right) return;
  Series none;  // Plotly hides an axis without a trace
  none.right_axis = true;
  Json trace = EmptyTrace(figure, panel, none, axes);
  Append(nullptr, nullptr, &trace);
  data->push_back(trace);
}

Json PlotlyBarTrace(const ColourBar& bar) {
  return {{"type", "scatter"},
          {"mode", "markers"},
          {"x", Json::array({nullptr})},
          {"y", Json::array({nullptr})},
          {"showlegend", false},
          {"hoverinfo", "skip"},
          {"marker", {{"color", Json::array({bar.low})}, {"coloraxis", "coloraxis"}}}};
}

Json PlotlyColourBar(const ColourBar& bar) {
  return {{"cmin", bar.low},
          {"cmax", bar.high},
          {"colorscale",
           Json::array({Json::array({0, kBarColours[0]}), Json::array({0.5, kBarColours[1]}),
                        Json::array({1, kBarColours[2]})})},
          {"colorbar",
           {{"title", {{"text", PlotlyText(bar.label)}, {"side", "bottom"}}},
            {"orientation", "h"},
            {"thickness", 10},
            {"len", 0.5},
            {"yref", "container"},
            {"y", 0},
            {"yanchor", "bottom"}}}};
}

}  // namespace lyrefit
