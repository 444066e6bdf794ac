#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr std::size_t kManyOfAGroup = 150;  // points; larger groups have small symbols
// Deviation of normal modules from a single-diode fit, in % of Isc.
constexpr double kBand = 0.2;
// Colours of causes, which differ from all colours of lines.
constexpr std::array<const char*, 4> kMarks = {"#F0B400", "#E05080", "#40C0A0", "#9070E0"};

// The points of one direction of one curve.
struct Group {
  Look look;
  std::vector<const DiagnosedPoint*> points = {};
};

struct ShownDiagnosis {
  std::vector<Group> groups;        // up and down of the first curve, then of the second, ...
  std::vector<std::string> legend;  // in the order of colours
  bool triangles = false;           // whether downward sweeps are triangles
  double low_V = kUnknown;          // of all voltages; unknown without points
  double span_V = 0;
  double unit_A = 1e-3;     // one hundredth of Isc; 1 mA without Isc
  std::vector<Band> bands;  // where causes act
  std::vector<Note> notes;  // their titles
};

// Whether the voltages fall, for each segment.
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

// Whether any curve was swept both ways.
bool BothWays(const Diagnosis& diagnosis, const std::vector<bool>& falling) {
  std::vector<int> ways(diagnosis.curves.size());
  for (const DiagnosedPoint& point : diagnosis.points) {
    ways[point.curve] |= falling[point.segment] ? 2 : 1;
  }
  return std::find(ways.begin(), ways.end(), 3) != ways.end();
}

// Groups the points: each curve has one colour, with triangles for downward sweeps if any curve was
// swept both ways. A single curve has one colour for each direction instead.
void AddGroups(const Diagnosis& diagnosis, ShownDiagnosis* shown) {
  const std::vector<bool> falling = Falling(diagnosis.points);
  const bool both_ways = BothWays(diagnosis, falling);
  const bool one = diagnosis.curves.size() == 1;
  shown->triangles = both_ways && !one;
  for (int curve = 0; curve < static_cast<int>(diagnosis.curves.size()); ++curve) {
    for (const bool down : {false, true}) {
      const std::string colour = LookOf(one && both_ways && down ? 1 : curve).colour;
      shown->groups.push_back({{colour, 1, down && shown->triangles ? 8 : 6}});
    }
    if (!one) shown->legend.push_back(diagnosis.curves[curve].name);
  }
  if (one && both_ways) shown->legend = {"up", "down"};
  for (const DiagnosedPoint& point : diagnosis.points) {
    shown->groups[2 * point.curve + (falling[point.segment] ? 1 : 0)].points.push_back(&point);
  }
}

// Ranges of voltage in which a cause acts. Neighbouring readings form one range, across gaps of up
// to gap_V.
std::vector<std::pair<double, double>> Stretches(const Diagnosis& diagnosis, const Cause& cause,
                                                 double gap_V) {
  std::vector<double> at;
  for (const int i : cause.points) {
    if (i >= 0 && i < static_cast<int>(diagnosis.points.size())) {
      at.push_back(diagnosis.points[i].voltage_V);
    }
  }
  std::sort(at.begin(), at.end());
  std::vector<std::pair<double, double>> stretches;
  for (const double v : at) {
    if (stretches.empty() || v > stretches.back().second + gap_V) stretches.emplace_back(v, v);
    stretches.back().second = v;
  }
  return stretches;
}

// Adds bands behind the points where causes act, with their titles below the curve.
void AddCauses(const Diagnosis& diagnosis, ShownDiagnosis* shown) {
  constexpr double kGap = 0.05;     // relative to the range of the voltages
  constexpr double kLeast = 0.004;  // half width of a band of one reading, relative to the range
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  const double air = kLeast * shown->span_V;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const char* const colour = kMarks[i % kMarks.size()];
    const auto stretches = Stretches(diagnosis, causes[i], kGap * shown->span_V);
    for (const auto& [low, high] : stretches) {
      shown->bands.push_back({true, low - air, high + air, colour, 0.18});
    }
    double middle = 0.5;
    if (!stretches.empty() && shown->span_V > 0) {
      const double middle_V = 0.5 * (stretches.front().first + stretches.back().second);
      middle = (middle_V - shown->low_V) / shown->span_V;
    }
    const double height = 0.06 + 0.09 * static_cast<double>(causes.size() - 1 - i);
    shown->notes.push_back({causes[i].title, colour, std::clamp(middle, 0.03, 0.97), height,
                            middle < 0.3   ? "left"
                            : middle > 0.7 ? "right"
                                           : "center"});
  }
}

ShownDiagnosis Collect(const Diagnosis& diagnosis) {
  ShownDiagnosis shown;
  double high_V = kUnknown, largest_A = 0;
  for (const DiagnosedPoint& point : diagnosis.points) {
    shown.low_V = std::fmin(shown.low_V, point.voltage_V);
    high_V = std::fmax(high_V, point.voltage_V);
    largest_A = std::max(largest_A, point.current_A);
  }
  if (!diagnosis.points.empty()) shown.span_V = high_V - shown.low_V;
  if (largest_A > 0) shown.unit_A = 0.01 * largest_A;
  AddGroups(diagnosis, &shown);
  AddCauses(diagnosis, &shown);
  return shown;
}

// One value of each point of a group over voltage.
template <typename Value>
Series OverVoltage(const Group& group, const Value& value) {
  Series series;
  int segment = -1;
  for (const DiagnosedPoint* point : group.points) {
    if (point->segment != segment && !series.rows.empty()) series.EndLine();
    segment = point->segment;
    series.Add(point->voltage_V, value(*point));
  }
  return series;
}

// Points with open or filled symbols.
Series Marked(const Group& group, Series series, bool filled) {
  series.kind = SeriesKind::kPoints;
  series.look = group.look;
  series.look.point += filled ? 1 : 0;
  series.size = group.points.size() > kManyOfAGroup ? 0.4 : 0.8;
  return series;
}

Series ModelLine(const Group& group, double DiagnosedPoint::*model_A, double width,
                 const Look& look) {
  Series series = OverVoltage(group, [&](const DiagnosedPoint& point) { return point.*model_A; });
  series.width = width;
  series.look = look;
  return series;
}

// A panel over voltage. All panels share one range, so that their points are aligned.
Panel VoltagePanel(const ShownDiagnosis& shown, const std::string& title,
                   const std::string& y_label) {
  const double air = shown.span_V > 0 ? 0.03 * shown.span_V : 1;
  Panel panel{
      title, {"Voltage (V)", shown.low_V - air, shown.low_V + shown.span_V + air}, {y_label}};
  panel.bands = shown.bands;
  panel.zero_line = true;
  return panel;
}

Panel CurvesPanel(const ShownDiagnosis& shown, const Diagnosis& diagnosis) {
  const bool found = diagnosis.verdict.found;
  const std::string title = fmt::format(
      "Measured points{} {} model (dashed){}", shown.triangles ? " (triangles: down)," : ",",
      diagnosis.base, found ? ", with the causes (solid), without them (grey)" : "");
  Panel panel = VoltagePanel(shown, title, "Current (A)");
  const auto current = [](const DiagnosedPoint& point) { return point.current_A; };
  for (const Group& group : shown.groups) {
    panel.series.push_back(Marked(group, OverVoltage(group, current), /*filled=*/false));
  }
  // Lines are drawn above all points.
  for (const Group& group : shown.groups) {
    panel.series.push_back(ModelLine(group, &DiagnosedPoint::before_A, 1.4, {"#000000", 2}));
    if (!found) continue;
    panel.series.push_back(ModelLine(group, &DiagnosedPoint::without_A, 1.2, {kGrey, 4}));
    panel.series.push_back(ModelLine(group, &DiagnosedPoint::after_A, 1.6, {group.look.colour}));
  }
  panel.y.tight = true;
  panel.y.air_high = 0.04;
  panel.y.air_low = 0.04 + 0.1 * static_cast<double>(shown.notes.size());  // for the titles
  panel.notes = shown.notes;
  return panel;
}

// Residuals, with the band that a single-diode fit leaves on normal modules.
Panel ResidualPanel(const ShownDiagnosis& shown, const std::string& title,
                    double DiagnosedPoint::*model_A) {
  Panel panel = VoltagePanel(shown, title, "Model - measured (% of Isc)");
  const auto residual = [&](const DiagnosedPoint& point) {
    return (point.*model_A - point.current_A) / shown.unit_A;
  };
  double largest = 0;
  for (const Group& group : shown.groups) {
    panel.series.push_back(Marked(group, OverVoltage(group, residual), /*filled=*/true));
    for (const auto& row : panel.series.back().rows) largest = std::max(largest, std::fabs(row[1]));
  }
  panel.y.high = std::max(1.1 * largest, 2 * kBand);
  panel.y.low = -panel.y.high;
  panel.bands.insert(panel.bands.begin(), {false, -kBand, kBand});
  return panel;
}

std::string Title(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  std::string title =
      fmt::format("{}: misfit {:.2f} % of Isc", diagnosis.name, 100 * verdict.lack_of_fit.value);
  if (verdict.found) {
    title += fmt::format(", with the causes {:.2f} %", 100 * verdict.remaining.value);
  }
  return title + (diagnosis.interrupted ? ", interrupted" : "");
}

}  // namespace

Figure DiagnosisFigure(const Diagnosis& diagnosis) {
  const ShownDiagnosis shown = Collect(diagnosis);
  Figure figure{Title(diagnosis), LegendOf(shown.legend, LegendMark::kBox)};
  figure.panels = {CurvesPanel(shown, diagnosis),
                   ResidualPanel(shown,
                                 "Residuals of the " + diagnosis.base +
                                     " model; band: what it misses of healthy modules",
                                 &DiagnosedPoint::before_A)};
  if (diagnosis.verdict.found) {
    figure.panels.push_back(
        ResidualPanel(shown, "Residuals with the causes", &DiagnosedPoint::after_A));
  }
  return figure;
}

void MarkCauses(const Diagnosis& diagnosis, Panel* panel) {
  const ShownDiagnosis shown = Collect(diagnosis);
  panel->bands.insert(panel->bands.end(), shown.bands.begin(), shown.bands.end());
  const double span_V = panel->x.high - panel->x.low;
  for (Note note : shown.notes) {
    const double at_V = shown.low_V + note.x * shown.span_V;
    if (span_V > 0) note.x = std::clamp((at_V - panel->x.low) / span_V, 0.03, 0.97);
    panel->notes.push_back(std::move(note));
  }
}

Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points) {
  return DrawFigure(DiagnosisFigure(diagnosis), path, points);
}

namespace {

block::Table DiagnosisReadings(const Diagnosis& diagnosis) {
  const bool many = diagnosis.curves.size() > 1;
  const bool found = diagnosis.verdict.found;
  block::Table table = {many ? "lrrrr" : "rrrr", {}};
  block::Table::Row head = {"voltage (V)", "measured (A)", "base model (A)", "base - measured (A)"};
  if (many) head.insert(head.begin(), "curve");
  if (found) head.insert(head.end(), {"with causes (A)", "with causes - measured (A)"});
  table.heads = {head};
  table.alignment.resize(head.size(), 'r');
  table.caption = "Readings, and the models' currents at their voltages.";
  std::vector<double> voltage_V, current_A;
  for (const DiagnosedPoint& point : diagnosis.points) {
    voltage_V.push_back(point.voltage_V);
    current_A.push_back(point.current_A);
  }
  for (const std::size_t i : RowsShown(voltage_V, current_A, &table.caption)) {
    const DiagnosedPoint& point = diagnosis.points[i];
    block::Table::Row row = {Significant(point.voltage_V, kReadingDigits),
                             Significant(point.current_A, kReadingDigits),
                             Significant(point.before_A, kReadingDigits),
                             Significant(point.before_A - point.current_A, kResidualDigits)};
    if (many) row.insert(row.begin(), diagnosis.curves[static_cast<std::size_t>(point.curve)].name);
    if (found) {
      row.push_back(Significant(point.after_A, kReadingDigits));
      row.push_back(Significant(point.after_A - point.current_A, kResidualDigits));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// "irradiance step at 12.1 to 17.3 V"
std::string WhereCausesAct(const Diagnosis& diagnosis) {
  std::string text;
  for (const Cause& cause : diagnosis.verdict.causes) {
    double low = kUnknown, high = kUnknown;
    for (const int i : cause.points) {
      if (i < 0 || i >= static_cast<int>(diagnosis.points.size())) continue;
      const double at_V = diagnosis.points[static_cast<std::size_t>(i)].voltage_V;
      low = std::fmin(low, at_V);
      high = std::fmax(high, at_V);
    }
    if (!std::isfinite(low)) continue;
    text += fmt::format("{}{} most from {} to {} V", text.empty() ? "" : ", ", cause.title,
                        Significant(low, 3), Significant(high, 3));
  }
  return text;
}

}  // namespace

block::Figure FigureBlock(const Diagnosis& diagnosis) {
  block::Figure shown;
  if (diagnosis.points.empty()) return shown;
  shown.caption = fmt::format(
      "Measured points and the {} model over voltage; below, what the model leaves in % of Isc, "
      "with a band of what one diode misses of healthy modules.",
      diagnosis.base);
  const std::string where = WhereCausesAct(diagnosis);
  if (!where.empty()) shown.caption += " Marked is where a cause acts: " + where + ".";
  shown.figure = DiagnosisFigure(diagnosis);
  shown.readings = DiagnosisReadings(diagnosis);
  return shown;
}

}  // namespace lyrefit
