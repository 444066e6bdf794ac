#include "lyrefit/report/diagnosis_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr std::size_t kManyOfAGroup = 150;  // of a group; from here on small symbols
// Of one diode fitted to healthy modules: how far the curve departs from it, in % of Isc.
constexpr double kBand = 0.2;
// Of causes: none of them the colour of a line.
constexpr std::array<const char*, 4> kMarks = {"#F0B400", "#E05080", "#40C0A0", "#9070E0"};

// One direction of one curve.
struct Group {
  Look look = {};
  Series measured = {};  // A over V
  Series base = {};
  Series extended = {};
  Series without = {};  // as if there were no cause
  Series before = {};   // residual over V
  Series after = {};
  int segment = -1;  // of the last point
};

// Where a cause acts.
struct Mark {
  std::string title;
  std::vector<std::pair<double, double>> bands;  // of the voltage, V
};

struct DiagnosisData {
  std::vector<Group> groups;  // up and down of the first curve, of the second, ...
  std::vector<Mark> marks;
  std::vector<std::string> legend;  // in the order of colours
  bool triangles = false;           // those of the way down
  double low_V = kUnknown;          // of all voltages; unknown without points
  double span_V = 0;
  double unit_A = 1;          // a hundredth of Isc; 1 mA where there is none
  double largest_before = 0;  // residual, in the unit it is drawn in
  double largest_after = 0;
};

double Residual(const DiagnosedPoint& point, double model_A, double unit_A) {
  return (model_A - point.current_A) / unit_A;
}

// Whether the voltages of each segment fall.
std::vector<bool> Falling(const std::vector<DiagnosedPoint>& points) {
  std::vector<bool> falling;
  std::vector<double> first_V;
  for (const DiagnosedPoint& point : points) {
    const auto segment = static_cast<std::size_t>(point.segment);
    if (segment >= first_V.size()) {
      first_V.resize(segment + 1, point.voltage_V);
      falling.resize(segment + 1);
    }
    falling[segment] = point.voltage_V < first_V[segment];
  }
  return falling;
}

// Whether some curve was swept both ways.
bool BothWays(const Diagnosis& diagnosis, const std::vector<bool>& falling) {
  std::vector<int> ways(diagnosis.curves.size());
  for (const DiagnosedPoint& point : diagnosis.points) {
    ways[point.curve] |= falling[point.segment] ? 2 : 1;
  }
  return std::find(ways.begin(), ways.end(), 3) != ways.end();
}

// A curve has one colour and, where directions matter, triangles for its way down; the only curve
// has two colours instead.
void AddGroups(const Diagnosis& diagnosis, bool both_ways, DiagnosisData* data) {
  const bool one = diagnosis.curves.size() == 1;
  data->triangles = both_ways && !one;
  for (int curve = 0; curve < static_cast<int>(diagnosis.curves.size()); ++curve) {
    for (const bool down : {false, true}) {
      Group group;
      group.look.colour = LookOf(one && both_ways && down ? 1 : curve).colour;
      group.look.point = down && data->triangles ? 8 : 6;
      data->groups.push_back(group);
    }
    if (!one) data->legend.push_back(diagnosis.curves[curve].name);
  }
  if (one && both_ways) data->legend = {"up", "down"};
}

void AddPoint(const DiagnosedPoint& point, double unit_A, Group* group) {
  const bool ends = group->segment != point.segment && !group->measured.rows.empty();
  group->segment = point.segment;
  const auto add = [&](Series* series, double y) {
    if (ends) series->EndLine();
    series->Add(point.voltage_V, y);
  };
  add(&group->measured, point.current_A);
  add(&group->base, point.before_A);
  add(&group->extended, point.after_A);
  add(&group->without, point.without_A);
  add(&group->before, Residual(point, point.before_A, unit_A));
  add(&group->after, Residual(point, point.after_A, unit_A));
}

// Readings that stand together become one band; gaps that some readings in between leave do not
// divide it.
Mark MakeMark(const Diagnosis& diagnosis, const Cause& cause) {
  constexpr double kGap = 0.05;  // of the range of the voltages
  Mark mark{cause.title, {}};
  std::vector<double> at;
  for (const int i : cause.points) {
    if (i >= 0 && i < static_cast<int>(diagnosis.points.size())) {
      at.push_back(diagnosis.points[i].voltage_V);
    }
  }
  if (at.empty()) return mark;
  std::sort(at.begin(), at.end());
  double low = at.front(), high = at.front();
  for (const DiagnosedPoint& point : diagnosis.points) {
    low = std::min(low, point.voltage_V);
    high = std::max(high, point.voltage_V);
  }
  const double gap = kGap * (high - low);
  for (const double v : at) {
    if (mark.bands.empty() || v > mark.bands.back().second + gap) {
      mark.bands.emplace_back(v, v);
    } else {
      mark.bands.back().second = v;
    }
  }
  return mark;
}

DiagnosisData Collect(const Diagnosis& diagnosis) {
  DiagnosisData data;
  double largest_A = 0;
  for (const DiagnosedPoint& point : diagnosis.points) {
    largest_A = std::max(largest_A, point.current_A);
  }
  if (!diagnosis.points.empty()) {
    const auto [low, high] = std::minmax_element(
        diagnosis.points.begin(), diagnosis.points.end(),
        [](const DiagnosedPoint& a, const DiagnosedPoint& b) { return a.voltage_V < b.voltage_V; });
    data.low_V = low->voltage_V;
    data.span_V = high->voltage_V - low->voltage_V;
  }
  data.unit_A = largest_A > 0 ? 0.01 * largest_A : 1e-3;
  const std::vector<bool> falling = Falling(diagnosis.points);
  AddGroups(diagnosis, BothWays(diagnosis, falling), &data);
  for (const DiagnosedPoint& point : diagnosis.points) {
    AddPoint(point, data.unit_A, &data.groups[2 * point.curve + (falling[point.segment] ? 1 : 0)]);
    const auto largest = [&](double model_A, double most) {
      const double residual = std::fabs(Residual(point, model_A, data.unit_A));
      return std::isfinite(residual) ? std::max(most, residual) : most;
    };
    data.largest_before = largest(point.before_A, data.largest_before);
    data.largest_after = largest(point.after_A, data.largest_after);
  }
  for (const Cause& cause : diagnosis.verdict.causes) {
    data.marks.push_back(MakeMark(diagnosis, cause));
  }
  return data;
}

const char* MarkColour(std::size_t index) { return kMarks[index % kMarks.size()]; }

// Bands behind the points where causes act.
void AddBands(const DiagnosisData& data, Panel* panel) {
  constexpr double kLeast = 0.004;  // half of a band of one reading, of the range
  const double air = kLeast * data.span_V;
  for (std::size_t i = 0; i < data.marks.size(); ++i) {
    for (const auto& [low, high] : data.marks[i].bands) {
      panel->bands.push_back({true, low - air, high + air, MarkColour(i), 0.18});
    }
  }
}

// The titles of the causes below the curve, each at its place.
std::vector<Note> MarkTitles(const DiagnosisData& data) {
  std::vector<Note> notes(data.marks.size());
  double height = 0.06;
  for (std::size_t i = notes.size(); i-- > 0; height += 0.09) {
    const auto& bands = data.marks[i].bands;
    double middle = 0.5;
    if (!bands.empty() && data.span_V > 0) {
      middle = (0.5 * (bands.front().first + bands.back().second) - data.low_V) / data.span_V;
    }
    const char* const side = middle < 0.3 ? "left" : middle > 0.7 ? "right" : "center";
    notes[i] = {data.marks[i].title, MarkColour(i), std::clamp(middle, 0.03, 0.97), height, side};
  }
  return notes;
}

// The voltages are the same in all panels, so that points stand above each other.
Panel VoltagePanel(const DiagnosisData& data, std::string title, std::string y_label) {
  Panel panel{std::move(title)};
  panel.x.label = "Voltage (V)";
  const double air = data.span_V > 0 ? 0.03 * data.span_V : 1;
  panel.x.low = data.low_V - air;
  panel.x.high = data.low_V + data.span_V + air;
  panel.y.label = std::move(y_label);
  panel.zero_line = true;
  return panel;
}

// Open or filled.
Series Marked(const Group& group, const Series& points, bool filled) {
  Series series = points;
  series.kind = SeriesKind::kPoints;
  series.look = group.look;
  series.look.point += filled ? 1 : 0;
  series.size = group.measured.rows.size() > kManyOfAGroup ? 0.4 : 0.8;
  return series;
}

Series Line(const Series& points, double width, const Look& look) {
  Series series = points;
  series.width = width;
  series.look = look;
  return series;
}

Panel CurvesPanel(const DiagnosisData& data, const Diagnosis& diagnosis) {
  const bool found = diagnosis.verdict.found;
  const char* const triangles = data.triangles ? " (triangles: down), " : ", ";
  Panel panel =
      VoltagePanel(data,
                   fmt::format("Measured points{}{} model (dashed){}", triangles, diagnosis.base,
                               found ? ", with the causes (solid), without them (grey)" : ""),
                   "Current (A)");
  for (const Group& group : data.groups) {
    panel.series.push_back(Marked(group, group.measured, /*filled=*/false));
  }
  // Above all points.
  for (const Group& group : data.groups) {
    panel.series.push_back(Line(group.base, 1.4, {"#000000", 2}));
    if (!found) continue;
    panel.series.push_back(Line(group.without, 1.2, {kGrey, 4}));
    panel.series.push_back(Line(group.extended, 1.6, {group.look.colour}));
  }
  panel.y.tight = true;
  panel.y.air_high = 0.04;
  panel.y.air_low = 0.04 + 0.1 * static_cast<double>(data.marks.size());  // for the titles
  panel.notes = MarkTitles(data);
  AddBands(data, &panel);
  return panel;
}

// Residuals with the band of what one diode misses of healthy modules.
Panel ResidualPanel(const DiagnosisData& data, std::string title, Series Group::*points,
                    double largest) {
  Panel panel = VoltagePanel(data, std::move(title), "Model - measured (% of Isc)");
  for (const Group& group : data.groups) {
    panel.series.push_back(Marked(group, group.*points, /*filled=*/true));
  }
  panel.y.high = std::max(1.1 * largest, 2 * kBand);
  panel.y.low = -panel.y.high;
  panel.bands = {{false, -kBand, kBand}};
  AddBands(data, &panel);
  return panel;
}

std::string Title(const Diagnosis& diagnosis) {
  const Gain& gain = diagnosis.gain;
  std::string title = fmt::format("{}: solved-current RMSE {} A", diagnosis.name,
                                  Scientific(gain.rmse_before_A, 3));
  if (diagnosis.verdict.found) {
    title += fmt::format(", with the causes {} A", Scientific(gain.rmse_after_A, 3));
  }
  return title + (diagnosis.interrupted ? ", interrupted" : "");
}

}  // namespace

Figure DiagnosisFigure(const Diagnosis& diagnosis) {
  const DiagnosisData data = Collect(diagnosis);
  Figure figure{Title(diagnosis), LegendOf(data.legend, LegendMark::kBox)};
  figure.panels.push_back(CurvesPanel(data, diagnosis));
  figure.panels.push_back(ResidualPanel(
      data,
      fmt::format("Residuals of the {} model; band: what it misses of healthy modules",
                  diagnosis.base),
      &Group::before, data.largest_before));
  if (diagnosis.verdict.found) {
    figure.panels.push_back(
        ResidualPanel(data, "Residuals with the causes", &Group::after, data.largest_after));
  }
  return figure;
}

Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points) {
  return DrawFigure(DiagnosisFigure(diagnosis), path, points);
}

}  // namespace lyrefit
