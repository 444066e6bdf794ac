#include "lyrefit/report/diagnosis_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "lyrefit/report/data_block.h"
#include "lyrefit/report/panels.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/thin_marks.h"

namespace lyrefit {
namespace {

constexpr std::size_t kManyOfAGroup = 150;  // of a group; from here on small symbols
constexpr double kBand = 2;                 // standard deviations
// Of causes: none of them the colour of a line.
constexpr std::array<const char*, 4> kMarks = {"#F0B400", "#E05080", "#40C0A0", "#9070E0"};

// One direction of one curve.
struct Group {
  int colour = 0;
  bool triangles = false;
  DataBlock measured;  // V, A
  DataBlock base;
  DataBlock extended;
  DataBlock before;  // V, residual
  DataBlock after;
  std::size_t points = 0;
  int segment = -1;  // of the last point
};

struct Mark {
  std::string title;
  DataBlock measured;
  DataBlock before;
  DataBlock after;
};

struct DiagnosisData {
  std::vector<Group> groups;  // up and down of the first curve, of the second, ...
  std::vector<Mark> marks;
  std::vector<std::string> legend;  // in the order of colours
  bool triangles = false;
  bool in_sigmas = true;
  double largest_before = 0;  // residual, in the unit it is drawn in
  double largest_after = 0;
};

double Residual(const DiagnosedPoint& point, double model_A, bool in_sigmas) {
  return (model_A - point.current_A) * (in_sigmas ? 1 / point.sigma_A : 1e3);
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
  return {colour,          triangles,     block("measured"), block("base"), block("extended"),
          block("before"), block("after")};
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

void AddPoint(const DiagnosedPoint& point, bool in_sigmas, Group* group) {
  if (group->segment != point.segment && group->points > 0) {
    group->base.EndLine();
    group->extended.EndLine();
  }
  group->segment = point.segment;
  ++group->points;
  group->measured.Add({point.voltage_V, point.current_A});
  group->base.Add({point.voltage_V, point.before_A});
  group->extended.Add({point.voltage_V, point.after_A});
  group->before.Add({point.voltage_V, Residual(point, point.before_A, in_sigmas)});
  group->after.Add({point.voltage_V, Residual(point, point.after_A, in_sigmas)});
}

Mark MakeMark(const Diagnosis& diagnosis, const Cause& cause, std::size_t index, bool in_sigmas,
              const std::vector<bool>& drawn) {
  const auto block = [index](const char* what) {
    return DataBlock(fmt::format("mark_{}{}", what, index));
  };
  Mark mark{cause.title, block("measured"), block("before"), block("after")};
  for (const int i : cause.points) {
    if (i < 0 || i >= static_cast<int>(diagnosis.points.size()) || !drawn[i]) continue;
    const DiagnosedPoint& point = diagnosis.points[i];
    mark.measured.Add({point.voltage_V, point.current_A});
    mark.before.Add({point.voltage_V, Residual(point, point.before_A, in_sigmas)});
    mark.after.Add({point.voltage_V, Residual(point, point.after_A, in_sigmas)});
  }
  return mark;
}

// Which points are drawn: all, or of each curve as many as can be told apart, and those that stand
// out before or after.
std::vector<bool> Drawn(const std::vector<DiagnosedPoint>& points, bool in_sigmas) {
  std::map<int, std::vector<std::size_t>> curves;
  for (std::size_t i = 0; i < points.size(); ++i) curves[points[i].curve].push_back(i);
  std::vector<bool> drawn(points.size());
  for (const auto& [curve, places] : curves) {
    for (const auto model : {&DiagnosedPoint::before_A, &DiagnosedPoint::after_A}) {
      std::vector<double> voltage_V, residual;
      for (const std::size_t i : places) {
        voltage_V.push_back(points[i].voltage_V);
        residual.push_back(Residual(points[i], points[i].*model, in_sigmas));
      }
      for (const std::size_t k : MarksToDraw(voltage_V, residual)) drawn[places[k]] = true;
    }
  }
  return drawn;
}

DiagnosisData Collect(const Diagnosis& diagnosis) {
  DiagnosisData data;
  data.in_sigmas = std::all_of(diagnosis.points.begin(), diagnosis.points.end(),
                               [](const DiagnosedPoint& point) { return point.sigma_A > 0; });
  const std::vector<bool> falling = Falling(diagnosis.points);
  AddGroups(diagnosis, BothWays(diagnosis, falling), &data);
  const std::vector<bool> drawn = Drawn(diagnosis.points, data.in_sigmas);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const DiagnosedPoint& point = diagnosis.points[i];
    if (drawn[i]) {
      AddPoint(point, data.in_sigmas,
               &data.groups[2 * point.curve + (falling[point.segment] ? 1 : 0)]);
    }
    const auto largest = [&](double model_A, double most) {
      const double residual = std::fabs(Residual(point, model_A, data.in_sigmas));
      return std::isfinite(residual) ? std::max(most, residual) : most;
    };
    data.largest_before = largest(point.before_A, data.largest_before);
    data.largest_after = largest(point.after_A, data.largest_after);
  }
  for (const Cause& cause : diagnosis.verdict.causes) {
    data.marks.push_back(MakeMark(diagnosis, cause, data.marks.size(), data.in_sigmas, drawn));
  }
  return data;
}

std::string Blocks(const DiagnosisData& data) {
  std::string text;
  for (const Group& group : data.groups) {
    text += group.measured.Text() + group.base.Text() + group.extended.Text() +
            group.before.Text() + group.after.Text();
  }
  for (const Mark& mark : data.marks) {
    text += mark.measured.Text() + mark.before.Text() + mark.after.Text();
  }
  return text;
}

const char* MarkColour(std::size_t index) { return kMarks[index % kMarks.size()]; }

// Large pale points under those of the curves.
void JoinMarks(const DiagnosisData& data, const DataBlock Mark::*block, double size,
               std::string* command) {
  for (std::size_t i = 0; i < data.marks.size(); ++i) {
    JoinPlot(data.marks[i].*block,
             fmt::format("using 1:2 with points pt 7 ps {} lc rgb '{}' notitle", 2.2 * size,
                         MarkColour(i)),
             command);
  }
}

// The titles of the causes in the lower left, which a curve leaves free, in the colours of their
// points.
std::string MarkLabels(const DiagnosisData& data) {
  std::string text;
  double height = 0.06;
  for (std::size_t i = data.marks.size(); i-- > 0; height += 0.09) {
    text += fmt::format(
        "set label {} {} at graph 0.05, graph {} left noenhanced point pt 7 ps 1.2 lc rgb '{}' "
        "offset 1,0\n",
        101 + i, GnuplotText(data.marks[i].title), height, MarkColour(i));
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
  JoinMarks(data, &Mark::measured, size, &command);
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
    JoinPlot(group.extended,
             fmt::format("using 1:2 with lines lw 1.6 lc rgb '{}' notitle", ColourOf(group.colour)),
             &command);
  }
  const double below = 0.04 + 0.1 * static_cast<double>(data.marks.size());  // for the titles
  return fmt::format(
             "set autoscale noextend\nset xzeroaxis lc rgb '#888888'\n"
             "set offsets 0, 0, graph 0.04, graph {}\n",
             below) +
         MarkLabels(data) + PlotLine(command);
}

// What a model leaves.
struct Remainder {
  DataBlock Group::*points;
  DataBlock Mark::*marked;
  double DiagnosisData::*largest;
};
constexpr Remainder kBefore = {&Group::before, &Mark::before, &DiagnosisData::largest_before};
constexpr Remainder kAfter = {&Group::after, &Mark::after, &DiagnosisData::largest_after};

// Residuals with the band of the noise.
std::string ResidualPanel(const DiagnosisData& data, const Remainder& remainder, double size) {
  std::string command;
  JoinMarks(data, remainder.marked, size, &command);
  for (const Group& group : data.groups) {
    JoinPlot(group.*remainder.points,
             fmt::format("using 1:2 with points pt {} ps {} lc rgb '{}' notitle",
                         group.triangles ? 9 : 7, SymbolSize(group, size), ColourOf(group.colour)),
             &command);
  }
  const double most = std::max(1.1 * data.*remainder.largest, data.in_sigmas ? 2 * kBand : 0);
  const double half = most > 0 ? most : 1;
  std::string text = fmt::format("set offsets 0, 0, 0, 0\nset yrange [{}:{}]\n", -half, half);
  if (data.in_sigmas) {
    text += fmt::format(
        "set object 1 rectangle from graph 0, first {} to graph 1, first {} fc rgb '#56B4E9' fs "
        "transparent solid 0.25 noborder behind\n",
        -kBand, kBand);
  }
  return text + PlotLine(command);
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
  const std::string unit = data.in_sigmas ? "Model - measured (sigma)" : "Model - measured (mA)";
  const std::string band = data.in_sigmas ? "; band: ± 2 sigma of the noise" : "";
  const std::string base = diagnosis.base + " model";
  std::string script = Blocks(data) + page.Begin(terminal) + VoltageRange(diagnosis.points);
  script += page.Place(
      0, {"Measured points" + std::string(data.triangles ? " (triangles: down), " : ", ") + base +
              " (dashed)" + (found ? ", with the causes (solid)" : ""),
          "Voltage (V)", "Current (A)"});
  script += CurvesPanel(data, found, size);
  script += page.Place(1, {"Residuals of the " + base + band, "Voltage (V)", unit});
  script += ResidualPanel(data, kBefore, size);
  if (found) {
    script += page.Place(2, {"Residuals with the causes" + band, "Voltage (V)", unit});
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
