#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lyrefit/report/figure_parts.h"
#include "lyrefit/report/html_parts.h"

namespace lyrefit {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kTitleRoom = 36;  // pixels above a panel
constexpr double kNarrowTitleRoom = 64;
constexpr double kNoTitleRoom = 14;
constexpr double kAxisRoom = 58;      // below a panel
constexpr double kUprightRoom = 1.6;  // of upright names, relative to that of slanted ones
constexpr double kColourRoom = 76;
constexpr double kColumnGap = 0.08;  // relative to the width

std::string Named(const char* what, const std::string& number) {
  return std::string(what) + (number == "1" ? "" : number);
}

double LogIf(bool log, double value) { return log ? std::log10(value) : value; }

// Lowest and highest value of a panel's data on one axis.
struct Ends {
  double low = kUnknown;
  double high = kUnknown;
};

Ends EndsOf(const Panel& panel, std::size_t coordinate, bool right_axis) {
  Ends ends;
  for (const Series& series : panel.series) {
    if (coordinate == 1 && series.right_axis != right_axis) continue;
    for (const auto& row : series.rows) {
      ends.low = std::fmin(ends.low, row[coordinate]);
      ends.high = std::fmax(ends.high, row[coordinate]);
    }
  }
  return ends;
}

// Range of an axis. Unknown ends follow the data with their margin; an end that Plotly selects is
// null.
Json RangeOf(const Axis& axis, Ends data) {
  if (axis.log) data = {std::log10(data.low), std::log10(data.high)};
  const double low = LogIf(axis.log, axis.low);
  const double high = LogIf(axis.log, axis.high);
  const bool tight = axis.tight || axis.air_low > 0 || axis.air_high > 0;
  const double span = std::fmax(high, data.high) - std::fmin(low, data.low);
  const auto end = [&](double stated, double found, double air) -> Json {
    if (std::isfinite(stated)) return stated;
    if (!tight || !std::isfinite(found)) return nullptr;
    return found + air * (std::isfinite(span) ? span : 0);
  };
  return Json::array({end(low, data.low, -axis.air_low), end(high, data.high, axis.air_high)});
}

Json AxisJson(const Axis& axis, const Ends& data, bool labelled) {
  Json json = {{"showline", true},           {"ticks", "outside"},     {"zeroline", false},
               {"linecolor", "#000000"},     {"gridcolor", "#d8d8d8"}, {"tickcolor", "#000000"},
               {"zerolinecolor", "#888888"}, {"automargin", "width"}};
  if (labelled) {
    json["title"] = {{"text", PlotlyText(axis.label)}, {"standoff", 8}};
    if (axis.colour != "black") json["title"]["font"] = {{"color", axis.colour}};
  }
  const Json range = RangeOf(axis, data);
  if (!range[0].is_null() || !range[1].is_null()) json["range"] = range;
  // Plotly forgets a single end when it makes room for the axis, unless it is stated here too.
  if (!axis.log && range[0].is_null() != range[1].is_null()) {
    json["autorangeoptions"] =
        range[0].is_null() ? Json{{"maxallowed", range[1]}} : Json{{"minallowed", range[0]}};
  }
  if (axis.log) {
    json["type"] = "log";
    json["exponentformat"] = "power";
  }
  if (!axis.ticks.empty()) {
    json["tickvals"] = Json::array();
    json["ticktext"] = Json::array();
    for (const Tick& tick : axis.ticks) {
      json["tickvals"].push_back(tick.place);
      json["ticktext"].push_back(PlotlyText(tick.name));
    }
  } else if (std::isfinite(axis.tick_step) && !axis.log) {
    json["tick0"] = axis.first_tick;
    json["dtick"] = axis.tick_step;
  }
  if (axis.slanted) json["tickangle"] = -40;
  return json;
}

std::string RuleColour(const Rule& rule) {
  return rule.colour == "black" ? "#000000" : rule.colour;
}

bool IsZeroLine(const Rule& rule) { return rule.y == 0 && !rule.right_axis; }

// Adds rules, bands, notes and titles to the layout.
void AddShapes(const Panel& panel, const PlotlyAxes& at, Json* layout) {
  Json& shapes = (*layout)["shapes"];
  Json& notes = (*layout)["annotations"];
  for (const Band& band : panel.bands) {
    Json shape = {{"type", "rect"},
                  {"layer", "below"},
                  {"fillcolor", band.colour},
                  {"opacity", band.opacity},
                  {"line", {{"width", 0}}}};
    shape["xref"] = band.upright ? at.x : at.x + " domain";
    shape["yref"] = band.upright ? at.y + " domain" : at.y;
    shape["x0"] = band.upright ? band.low : 0;
    shape["x1"] = band.upright ? band.high : 1;
    shape["y0"] = band.upright ? 0 : band.low;
    shape["y1"] = band.upright ? 1 : band.high;
    shapes.push_back(shape);
  }
  const auto rule = [&](double y, const std::string& axis, const Json& line) {
    shapes.push_back({{"type", "line"},
                      {"layer", "above"},
                      {"xref", at.x + " domain"},
                      {"x0", 0},
                      {"x1", 1},
                      {"yref", axis},
                      {"y0", y},
                      {"y1", y},
                      {"line", line}});
  };
  for (const Rule& one : panel.rules) {
    if (IsZeroLine(one)) continue;  // Plotly draws its own zero line, below the readings
    rule(one.y, one.right_axis ? at.right : at.y,
         {{"color", RuleColour(one)}, {"width", one.width}, {"dash", PlotlyDash(one.dash)}});
  }
  const auto note = [&](const std::string& text, double x, double y) {
    return Json{{"text", PlotlyText(text)}, {"showarrow", false},
                {"xref", at.x + " domain"}, {"x", x},
                {"yref", at.y + " domain"}, {"y", y}};
  };
  if (!panel.title.empty()) {
    Json title = note(panel.title, 0.5, 1);
    title["name"] = "title";  // wrapped by the page
    title["yanchor"] = "bottom";
    title["yshift"] = 4;
    notes.push_back(title);
  }
  for (const Note& one : panel.notes) {
    Json text = note(one.text, one.x, one.y);
    text["xanchor"] = one.side;
    text["font"] = {{"color", one.colour}};
    notes.push_back(text);
  }
}

// Positions of the panels for a number of columns, as the page changes them with its width. The
// legend is above the panels. In a narrow page slanted names of ticks stand upright.
Json Places(const Figure& figure, int columns, bool narrow) {
  const int panels = static_cast<int>(figure.panels.size());
  const bool titled = std::any_of(figure.panels.begin(), figure.panels.end(),
                                  [](const Panel& panel) { return !panel.title.empty(); });
  const double title_room = !titled ? kNoTitleRoom : narrow ? kNarrowTitleRoom : kTitleRoom;
  const double margin_below = figure.margin_below * (narrow ? kUprightRoom : 1);
  std::vector<double> top;
  double height = 0;
  for (int p = 0; p < panels; ++p) {
    const bool begins = p % columns == 0;
    top.push_back(begins ? height + title_room : top.back());
    if (begins) {
      height += title_room + figure.panels[p].height + kAxisRoom + margin_below;
    }
  }
  const double last_axis = kAxisRoom + margin_below;
  const double area = std::max(1.0, height - last_axis);
  const double width = (1 - (columns - 1) * kColumnGap) / columns;
  Json places = Json::object();
  for (int p = 0; p < panels; ++p) {
    const double left = p % columns * (width + kColumnGap);
    const double below = 1 - (top[p] + figure.panels[p].height) / area;
    const std::string number = std::to_string(p + 1);
    places[Named("xaxis", number) + ".domain"] = {left, std::min(1.0, left + width)};
    places[Named("yaxis", number) + ".domain"] = {std::max(0.0, below), 1 - top[p] / area};
    if (narrow && figure.panels[p].x.slanted) places[Named("xaxis", number) + ".tickangle"] = -90;
  }
  const double under = last_axis + (figure.colour_bar ? kColourRoom : 0);
  places["height"] = std::round(area + under);
  places["margin.b"] = under;
  return places;
}

// Whether two panels zoom along x together.
bool SharesX(const Panel& a, const Panel& b) {
  return a.x.label == b.x.label && a.x.log == b.x.log && a.x.low == b.x.low && a.x.high == b.x.high;
}

PlotlyAxes AxesOf(const Figure& figure, std::size_t p) {
  std::size_t right = figure.panels.size();
  for (std::size_t i = 0; i <= p; ++i) right += figure.panels[i].right ? 1 : 0;
  const std::string number = std::to_string(p + 1);
  return {Named("x", number), Named("y", number),
          figure.panels[p].right ? "y" + std::to_string(right) : Named("y", number)};
}

void AddAxes(const Figure& figure, std::size_t p, int columns, Json* layout) {
  const Panel& panel = figure.panels[p];
  const PlotlyAxes at = AxesOf(figure, p);
  const auto long_name = [](const std::string& axis) {
    return axis.substr(0, 1) + "axis" + axis.substr(1);
  };
  Json x = AxisJson(panel.x, EndsOf(panel, 0, false), true);
  x["anchor"] = at.y;
  for (std::size_t i = 0; i < p; ++i) {
    if (!SharesX(figure.panels[i], panel)) continue;
    x["matches"] = AxesOf(figure, i).x;
    break;
  }
  (*layout)[long_name(at.x)] = x;
  const bool on_the_left = p % static_cast<std::size_t>(columns) == 0;
  Json y = AxisJson(panel.y, EndsOf(panel, 1, false), on_the_left);
  y["anchor"] = at.x;
  y["zeroline"] = panel.zero_line;
  for (const Rule& rule : panel.rules) {
    if (!IsZeroLine(rule)) continue;
    y["zeroline"] = true;
    y["zerolinecolor"] = RuleColour(rule);
  }
  (*layout)[long_name(at.y)] = y;
  if (!panel.right) return;
  Json right = AxisJson(*panel.right, EndsOf(panel, 1, true), true);
  right["anchor"] = at.x;
  right["overlaying"] = at.y;
  right["side"] = "right";
  right["showgrid"] = false;
  right["tickmode"] = "auto";  // independent round numbers
  (*layout)[long_name(at.right)] = right;
}

}  // namespace

std::string PlotlyJson(const Figure& figure) {
  const int panels = static_cast<int>(figure.panels.size());
  const int columns = std::max(1, std::min(figure.columns, panels));
  Json layout = {{"shapes", Json::array()}, {"annotations", Json::array()}};
  layout["hovermode"] = "closest";
  layout["barmode"] = "overlay";
  layout["dragmode"] = "zoom";
  layout["margin"] = {{"l", 56}, {"r", 20}, {"t", 8}, {"b", kAxisRoom}};
  const MostRows most = MostOf(figure);
  Json data = PlotlyLegend(figure);
  for (std::size_t p = 0; p < figure.panels.size(); ++p) {
    AddAxes(figure, p, columns, &layout);
    AddShapes(figure.panels[p], AxesOf(figure, p), &layout);
    AddPlotlyTraces(figure, figure.panels[p], AxesOf(figure, p), most, &data);
  }
  if (figure.colour_bar) {
    layout["coloraxis"] = PlotlyColourBar(*figure.colour_bar);
    data.push_back(PlotlyBarTrace(*figure.colour_bar));
  }
  const Json json = {{"title", PlotlyText(figure.title)},
                     {"columns", columns},
                     {"data", data},
                     {"layout", layout},
                     {"wide", Places(figure, columns, false)},
                     {"narrow", Places(figure, 1, true)}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lyrefit
