#include "lyrefit/report/family_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/law/extended_set.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/law/quote.h"
#include "lyrefit/report/data_block.h"
#include "lyrefit/report/panels.h"
#include "lyrefit/report/plot.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/report/thin_marks.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostDrawn = 12;
constexpr int kFamilyModelPoints = 200;
constexpr int kColourBar = 60;  // room for it under the panels, in pixels

using CurveOf = std::map<std::string, const IvCurve*>;

double OrZero(double value) { return std::isnan(value) ? 0 : value; }

// Stated and corrected conditions of a curve.
double Irradiance(const FamilyReport& report, const FamilyCurve& curve) {
  return curve.irradiance_W_m2 + OrZero(curve.irradiance_offset_W_m2.value) +
         OrZero(report.irradiance_offset_W_m2.value);
}
double Temperature_K(const FamilyReport& report, const FamilyCurve& curve) {
  return curve.temperature_C + kZeroCelsius_K + OrZero(curve.temperature_offset_K.value) +
         OrZero(report.temperature_offset_K.value);
}

// Those of a model with effects.
std::vector<double> ExtendedModelCurrents(const FamilyReport& report, const FamilyCurve& curve,
                                          const std::vector<double>& voltage_V) {
  const std::vector<IvCurve>& taken = report.taken->curves;
  const auto found = std::find_if(taken.begin(), taken.end(),
                                  [&](const IvCurve& one) { return one.name == curve.id; });
  if (found == taken.end()) return {};
  const Translation& at = report.translation;
  if (at.extended && !report.refined.empty()) {
    const Device device = OfCurve(*at.extended, static_cast<int>(found - taken.begin()));
    return SolveCurrents(device, ExtendedParameters(at, report.refined.data()).data(), voltage_V);
  }
  const TranslationSpec& spec = at.spec;
  const auto device = Extend(MakeDevice(spec.model, found->conditions, spec.constants), spec.model,
                             spec.constants, *found, report.with, /*force=*/true);
  if (!device || static_cast<int>(curve.free_parameters.size()) != device->size()) return {};
  return SolveCurrents(*device, Inner(*device, curve.free_parameters).data(), voltage_V);
}

// The model's currents; empty where the curve has no parameters.
std::vector<double> ModelCurrents(const FamilyReport& report, const FamilyCurve& curve,
                                  const std::vector<double>& voltage_V) {
  if (report.taken != nullptr) return ExtendedModelCurrents(report, curve, voltage_V);
  if (!report.estimates.empty() && !report.refined.empty()) {
    const TranslatedDevice at =
        TranslateTo(report.translation, report.refined, Irradiance(report, curve),
                    Temperature_K(report, curve));
    return SolveCurrents(at.device, at.parameters.data(), voltage_V);
  }
  Conditions conditions;
  conditions.cell_temperature_K = curve.temperature_C + kZeroCelsius_K;
  conditions.cells_in_series = report.cells_in_series;
  const TranslationSpec& spec = report.translation.spec;
  const Device device = MakeDevice(spec.model, conditions, spec.constants);
  if (static_cast<int>(curve.free_parameters.size()) != device.size()) return {};
  return SolveCurrents(device, curve.free_parameters.data(), voltage_V);
}

// Up to twelve curves, evenly spread over the irradiances: most of a sunny day looks alike.
std::vector<const FamilyCurve*> Drawn(const FamilyReport& report, const CurveOf& points) {
  std::vector<const FamilyCurve*> curves;
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role == CurveRole::kLeftOut || points.count(curve.id) == 0) continue;
    if (points.at(curve.id)->size() > 0) curves.push_back(&curve);
  }
  std::stable_sort(curves.begin(), curves.end(), [](const FamilyCurve* a, const FamilyCurve* b) {
    return a->irradiance_W_m2 < b->irradiance_W_m2;
  });
  if (curves.size() <= kMostDrawn) return curves;
  const double least = curves.front()->irradiance_W_m2;
  const double step = (curves.back()->irradiance_W_m2 - least) / (kMostDrawn - 1);
  std::vector<const FamilyCurve*> drawn;
  for (std::size_t i = 0; i < kMostDrawn; ++i) {
    const double wanted = least + step * static_cast<double>(i);
    const FamilyCurve* const nearest = *std::min_element(
        curves.begin(), curves.end(), [wanted](const FamilyCurve* a, const FamilyCurve* b) {
          return std::fabs(a->irradiance_W_m2 - wanted) < std::fabs(b->irradiance_W_m2 - wanted);
        });
    if (drawn.empty() || drawn.back() != nearest) drawn.push_back(nearest);
  }
  return drawn;
}

struct FamilyData {
  DataBlock measured{"measured"};
  DataBlock model{"model"};
  DataBlock fitted{"fitted"};      // irradiance, RMSE in mA, temperature
  DataBlock held_out{"held_out"};  // the same
  DataBlock mean{"mean"};          // of fitted curves: irradiance, mean residual in mA, temperature
  DataBlock mean_held_out{"mean_held_out"};
  double lowest_V = 0;
  double highest_V = 0;
  double lowest_A = 0;
  double highest_A = 0;
  double coldest_C = 1e9;
  double hottest_C = -1e9;
};

void AddCurve(const FamilyReport& report, const FamilyCurve& curve, const IvCurve& points,
              FamilyData* data) {
  for (const std::size_t i : MarksToDraw(points.voltage_V, points.current_A)) {
    data->measured.Add({points.voltage_V[i], points.current_A[i], curve.temperature_C});
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    data->lowest_V = std::min(data->lowest_V, points.voltage_V[i]);
    data->highest_V = std::max(data->highest_V, points.voltage_V[i]);
    data->lowest_A = std::min(data->lowest_A, points.current_A[i]);
    data->highest_A = std::max(data->highest_A, points.current_A[i]);
  }
  const auto [low, high] = std::minmax_element(points.voltage_V.begin(), points.voltage_V.end());
  std::vector<double> voltage_V(kFamilyModelPoints);
  for (int i = 0; i < kFamilyModelPoints; ++i) {
    voltage_V[i] = *low + (*high - *low) * i / (kFamilyModelPoints - 1);
  }
  const std::vector<double> current_A = ModelCurrents(report, curve, voltage_V);
  for (std::size_t i = 0; i < current_A.size(); ++i) {
    data->model.Add({voltage_V[i], current_A[i], curve.temperature_C});
  }
  data->model.EndLine();
}

FamilyData Collect(const FamilyReport& report, const CurveSet& set) {
  CurveOf points;
  for (const IvCurve& curve : set.curves) points[curve.name] = &curve;
  FamilyData data;
  for (const FamilyCurve* curve : Drawn(report, points)) {
    AddCurve(report, *curve, *points.at(curve->id), &data);
  }
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role == CurveRole::kLeftOut) continue;
    const RmsePair& rmse = report.estimates.empty() ? curve.free_rmse : curve.rmse;
    const bool held_out = curve.role == CurveRole::kHeldOut;
    DataBlock* const errors = held_out ? &data.held_out : &data.fitted;
    errors->Add({curve.irradiance_W_m2, 1e3 * rmse.solved_current_A, curve.temperature_C});
    DataBlock* const means = held_out ? &data.mean_held_out : &data.mean;
    means->Add({curve.irradiance_W_m2, 1e3 * curve.mean_residual_A, curve.temperature_C});
    data.coldest_C = std::min(data.coldest_C, curve.temperature_C);
    data.hottest_C = std::max(data.hottest_C, curve.temperature_C);
  }
  return data;
}

std::string ColourBar(const FamilyData& data) {
  const bool one = !(data.hottest_C - data.coldest_C > 0.5);
  return fmt::format(
      "set palette defined (0 '#0072B2', 0.5 '#8C8C8C', 1 '#D55E00')\n"
      "set cbrange [{:g}:{:g}]\n"
      "set colorbox horizontal user origin screen 0.36, screen 0.105 size screen 0.28, screen "
      "0.025\n"
      "set cblabel 'Cell temperature (C)' offset 0,0.4\n",
      one ? data.coldest_C - 1 : data.coldest_C, one ? data.hottest_C + 1 : data.hottest_C);
}

// Where an axis begins: at 0 if only the scatter of its first points lies below.
const char* AxisBegin(double lowest, double highest) {
  constexpr double kScatter = 0.02;
  return lowest < -kScatter * highest ? "*" : "0";
}

// The points of both blocks: filled those fitted, open those held out, beneath them.
std::string BothRoles(const DataBlock& held_out, const DataBlock& fitted, double size) {
  constexpr char kPoints[] = "using 1:2:3 with points pt {} ps {} lc palette notitle";
  std::string command;
  JoinPlot(held_out, fmt::format(kPoints, 6, size), &command);
  JoinPlot(fitted, fmt::format(kPoints, 7, size), &command);
  return command;
}

std::string Title(const FamilyReport& report) {
  const bool shared = !report.estimates.empty();
  std::string title =
      fmt::format("{}: {} {}", report.name, shared ? ToText(report.translation.spec.law) : "free",
                  ToText(report.translation.spec.model));
  if (shared) {
    const auto fitted =
        std::count_if(report.curves.begin(), report.curves.end(),
                      [](const FamilyCurve& curve) { return curve.role == CurveRole::kFitted; });
    title += PlusEffects(report.with);
    title += fmt::format(", solved-current RMSE {} A over {} curves fitted",
                         Scientific(report.rmse.refined.solved_current_A, 4), fitted);
  }
  return title + (report.interrupted ? ", interrupted" : "");
}

std::string CurvesPanel(const FamilyData& data, double size) {
  std::string curves;
  JoinPlot(data.measured,
           fmt::format("using 1:2:3 with points pt 6 ps {} lc palette notitle", 0.7 * size),
           &curves);
  JoinPlot(data.model, "using 1:2:3 with lines lw 1.6 lc palette notitle", &curves);
  return fmt::format("set xrange [{}:*]\nset yrange [{}:*]\n",
                     AxisBegin(data.lowest_V, data.highest_V),
                     AxisBegin(data.lowest_A, data.highest_A)) +
         PlotLine(curves) + "unset colorbox\nset xrange [*:*]\n";
}

std::string Script(const FamilyReport& report, const FamilyData& data,
                   const std::string& terminal) {
  const PanelPage page(3, 3, Title(report), LegendMark::kLine, {}, kColourBar);
  const double size = PointSize(terminal);
  const std::string open = data.held_out.empty() ? "" : "; open: held out";
  std::string script = data.measured.Text() + data.model.Text() + data.fitted.Text() +
                       data.held_out.Text() + data.mean.Text() + data.mean_held_out.Text() +
                       page.Begin(terminal) + ColourBar(data);
  script += page.Place(0, {"Measured points and model", "Voltage (V)", "Current (A)"});
  script += CurvesPanel(data, size);
  script += page.Place(
      1, {"RMSE of each curve (mA, solved-current" + open + ")", "Irradiance (W/m2)", ""});
  script += "set offsets graph 0.04, graph 0.04, graph 0.06, 0\nset yrange [0:*]\n";
  script += PlotLine(BothRoles(data.held_out, data.fitted, 1.2 * size));
  script += page.Place(2, {"Mean of model - measured (mA" + open + ")", "Irradiance (W/m2)", ""});
  script += "set offsets graph 0.04, graph 0.04, graph 0.06, graph 0.06\nset yrange [*:*]\n";
  script += "set xzeroaxis lc rgb '#888888'\n";
  script += PlotLine(BothRoles(data.mean_held_out, data.mean, 1.2 * size));
  return script + PanelPage::End();
}

}  // namespace

Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set,
                          const std::string& path) {
  const FamilyData data = Collect(report, set);
  return DrawScript([&](const std::string& terminal) { return Script(report, data, terminal); },
                    path);
}

}  // namespace lyrefit
