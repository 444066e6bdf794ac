#include "lyrefit/report/diagnosis_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "lyrefit/report/data_block.h"
#include "lyrefit/report/panels.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/thin_marks.h"

namespace lyrefit {
namespace {

constexpr std::size_t kManyOfAGroup = 150;  // of a group; from here on small symbols
// Of one diode fitted to healthy modules: how far the curve departs from it, in % of Isc.
constexpr double kBand = 0.2;
// Of causes: none of them the colour of a line.
constexpr std::array<const char*, 4> kMarks = {"#F0B400", "#E05080", "#40C0A0", "#9070E0"};

// One direction of one curve.
struct Group {
  int colour = 0;
  bool triangles = false;
  DataBlock measured;  // V, A
  DataBlock base;
  DataBlock extended;
  DataBlock without;  // V, A, as if there were no cause
  DataBlock before;   // V, residual
  DataBlock after;
  std::size_t points = 0;
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
  bool triangles = false;
  double low_V = 0;  // of all voltages
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

Group MakeGroup(int colour, bool triangles, std::size_t index) {
  const auto block = [index](const char* what) {
    return DataBlock(fmt::format("{}{}", what, index));
  };
  return {colour,           triangles,       block("measured"), block("base"), block("extended"),
          block("without"), block("before"), block("after")};
}

// A curve has one colour and, where directions matter, triangles for its way down; the only curve
// has two colours instead.
void AddGroups(const Diagnosis& diagnosis, bool both_ways, DiagnosisData* data) {
  const bool one = diagnosis.curves.size() == 1;
  data->triangles = both_ways && !one;
  for (int curve = 0; curve < static_cast<int>(diagnosis.curves.size()); ++curve) {
    for (const bool down : {false, true}) {
      const int colour = one && both_ways && down ? 1 : curve;
      data->groups.push_back(MakeGroup(colour, down && data->triangles, data->groups.size()));
    }
    if (!one) data->legend.push_back(diagnosis.curves[curve].name);
  }
  if (one && both_ways) data->legend = {"up", "down"};
}

void AddPoint(const DiagnosedPoint& point, double unit_A, Group* group) {
  if (group->segment != point.segment && group->points > 0) {
    group->base.EndLine();
    group->extended.EndLine();
    group->without.EndLine();
  }
  group->segment = point.segment;
  ++group->points;
  group->measured.Add({point.voltage_V, point.current_A});
  group->base.Add({point.voltage_V, point.before_A});
  group->extended.Add({point.voltage_V, point.after_A});
  group->without.Add({point.voltage_V, point.without_A});
  group->before.Add({point.voltage_V, Residual(point, point.before_A, unit_A)});
  group->after.Add({point.voltage_V, Residual(point, point.after_A, unit_A)});
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

// Which points are drawn: all, or of each curve as many as can be told apart, and those that stand
// out before or after.
std::vector<bool> Drawn(const std::vector<DiagnosedPoint>& points, double unit_A) {
  std::map<int, std::vector<std::size_t>> curves;
  for (std::size_t i = 0; i < points.size(); ++i) curves[points[i].curve].push_back(i);
  std::vector<bool> drawn(points.size());
  for (const auto& [curve, places] : curves) {
    for (const auto model : {&DiagnosedPoint::before_A, &DiagnosedPoint::after_A}) {
      std::vector<double> voltage_V, residual;
      for (const std::size_t i : places) {
        voltage_V.push_back(points[i].voltage_V);
        residual.push_back(Residual(points[i], points[i].*model, unit_A));
      }
      for (const std::size_t k : MarksToDraw(voltage_V, residual)) drawn[places[k]] = true;
    }
  }
  return drawn;
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
  const std::vector<bool> drawn = Drawn(diagnosis.points, data.unit_A);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const DiagnosedPoint& point = diagnosis.points[i];
    if (drawn[i]) {
      AddPoint(point, data.unit_A,
               &data.groups[2 * point.curve + (falling[point.segment] ? 1 : 0)]);
    }
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

std::string Blocks(const DiagnosisData& data) {
  std::string text;
  for (const Group& group : data.groups) {
    text += group.measured.Text() + group.base.Text() + group.extended.Text() +
            group.without.Text() + group.before.Text() + group.after.Text();
  }
  return text;
}

const char* MarkColour(std::size_t index) { return kMarks[index % kMarks.size()]; }

// Bands behind the points where causes act.
std::string Bands(const DiagnosisData& data) {
  constexpr double kLeast = 0.004;  // half of a band of one reading, of the range
  std::string text;
  int object = 10;
  for (std::size_t i = 0; i < data.marks.size(); ++i) {
    for (const auto& [low, high] : data.marks[i].bands) {
      const double air = kLeast * data.span_V;
      text += fmt::format(
          "set object {} rectangle from first {}, graph 0 to first {}, graph 1 fc rgb '{}' fs "
          "transparent solid 0.18 noborder behind\n",
          object++, low - air, high + air, MarkColour(i));
    }
  }
  return text;
}

// The titles of the causes below the curve, each at its place.
std::string MarkLabels(const DiagnosisData& data) {
  std::string text;
  double height = 0.06;
  for (std::size_t i = data.marks.size(); i-- > 0; height += 0.09) {
    const auto& bands = data.marks[i].bands;
    double middle = 0.5;
    if (!bands.empty() && data.span_V > 0) {
      middle = (0.5 * (bands.front().first + bands.back().second) - data.low_V) / data.span_V;
    }
    const char* const side = middle < 0.3 ? "left" : middle > 0.7 ? "right" : "center";
    text += fmt::format("set label {} {} at graph {:.3f}, graph {} {} noenhanced tc rgb '{}'\n",
                        101 + i, GnuplotText(data.marks[i].title),
                        std::min(std::max(middle, 0.03), 0.97), height, side, MarkColour(i));
  }
  return text;
}

double SymbolSize(const Group& group, double size) {
  return group.points > kManyOfAGroup ? 0.4 * size : 0.8 * size;
}

// The same in all panels, so that points stand above each other.
std::string VoltageRange(const std::vector<DiagnosedPoint>& points) {
  if (points.empty()) return "";
  const auto [low, high] = std::minmax_element(
      points.begin(), points.end(),
      [](const DiagnosedPoint& a, const DiagnosedPoint& b) { return a.voltage_V < b.voltage_V; });
  const double span = high->voltage_V - low->voltage_V;
  const double air = span > 0 ? 0.03 * span : 1;
  return fmt::format("set xrange [{}:{}]\n", low->voltage_V - air, high->voltage_V + air);
}

std::string CurvesPanel(const DiagnosisData& data, bool found, double size) {
  std::string command;
  for (const Group& group : data.groups) {
    JoinPlot(group.measured,
             fmt::format("using 1:2 with points pt {} ps {} lc rgb '{}' notitle",
                         group.triangles ? 8 : 6, SymbolSize(group, size), ColourOf(group.colour)),
             &command);
  }
  // Above all points.
  for (const Group& group : data.groups) {
    JoinPlot(group.base, "using 1:2 with lines lw 1.4 dt 2 lc rgb '#000000' notitle", &command);
    if (!found) continue;
    JoinPlot(group.without, "using 1:2 with lines lw 1.2 dt 4 lc rgb '#888888' notitle", &command);
    JoinPlot(group.extended,
             fmt::format("using 1:2 with lines lw 1.6 lc rgb '{}' notitle", ColourOf(group.colour)),
             &command);
  }
  const double below = 0.04 + 0.1 * static_cast<double>(data.marks.size());  // for the titles
  return fmt::format(
             "set autoscale noextend\nset xzeroaxis lc rgb '#888888'\n"
             "set offsets 0, 0, graph 0.04, graph {}\n",
             below) +
         Bands(data) + MarkLabels(data) + PlotLine(command);
}

// What a model leaves.
struct Remainder {
  DataBlock Group::*points;
  double DiagnosisData::*largest;
};
constexpr Remainder kBefore = {&Group::before, &DiagnosisData::largest_before};
constexpr Remainder kAfter = {&Group::after, &DiagnosisData::largest_after};

// Residuals with the band of what one diode misses of healthy modules.
std::string ResidualPanel(const DiagnosisData& data, const Remainder& remainder, double size) {
  std::string command;
  for (const Group& group : data.groups) {
    JoinPlot(group.*remainder.points,
             fmt::format("using 1:2 with points pt {} ps {} lc rgb '{}' notitle",
                         group.triangles ? 9 : 7, SymbolSize(group, size), ColourOf(group.colour)),
             &command);
  }
  const double half = std::max(1.1 * data.*remainder.largest, 2 * kBand);
  return fmt::format(
             "set offsets 0, 0, 0, 0\nset yrange [{}:{}]\n"
             "set object 1 rectangle from graph 0, first {} to graph 1, first {} fc rgb '#56B4E9' "
             "fs transparent solid 0.25 noborder behind\n",
             -half, half, -kBand, kBand) +
         Bands(data) + PlotLine(command);
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

std::string Script(const Diagnosis& diagnosis, const DiagnosisData& data,
                   const std::string& terminal) {
  const bool found = diagnosis.verdict.found;
  const PanelPage page(found ? 3 : 2, 1, Title(diagnosis), LegendMark::kBox, data.legend, 0);
  const double size = PointSize(terminal);
  const std::string unit = "Model - measured (% of Isc)";
  const std::string band = "; band: what it misses of healthy modules";
  const std::string base = diagnosis.base + " model";
  std::string script = Blocks(data) + page.Begin(terminal) + VoltageRange(diagnosis.points);
  script += page.Place(
      0, {"Measured points" + std::string(data.triangles ? " (triangles: down), " : ", ") + base +
              " (dashed)" + (found ? ", with the causes (solid), without them (grey)" : ""),
          "Voltage (V)", "Current (A)"});
  script += CurvesPanel(data, found, size);
  script += page.Place(1, {"Residuals of the " + base + band, "Voltage (V)", unit});
  script += ResidualPanel(data, kBefore, size);
  if (found) {
    script += page.Place(2, {"Residuals with the causes", "Voltage (V)", unit});
    script += ResidualPanel(data, kAfter, size);
  }
  return script + PanelPage::End();
}

}  // namespace

Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path) {
  const DiagnosisData data = Collect(diagnosis);
  return DrawScript([&](const std::string& terminal) { return Script(diagnosis, data, terminal); },
                    path);
}

}  // namespace lyrefit
