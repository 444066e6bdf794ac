#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/family_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "lyrefit/model/extended_set.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/reporting_units.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostDrawn = 12;
constexpr int kFamilyModelPoints = 200;

using CurveOf = std::map<std::string, const IvCurve*>;

double OrZero(double value) { return std::isnan(value) ? 0 : value; }

// Stated conditions of a curve plus their fitted corrections.
double Irradiance(const FamilyReport& report, const FamilyCurve& curve) {
  return curve.irradiance_W_m2 + OrZero(curve.irradiance_offset_W_m2.value) +
         OrZero(report.irradiance_offset_W_m2.value);
}
double Temperature_K(const FamilyReport& report, const FamilyCurve& curve) {
  return curve.temperature_C + kZeroCelsius_K + OrZero(curve.temperature_offset_K.value) +
         OrZero(report.temperature_offset_K.value);
}

// Currents of a model with effects.
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
  if (!device || static_cast<int>(curve.individual_parameters.size()) != device->size()) return {};
  return SolveCurrents(*device, Internal(*device, curve.individual_parameters).data(), voltage_V);
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
  if (static_cast<int>(curve.individual_parameters.size()) != device.size()) return {};
  return SolveCurrents(device, curve.individual_parameters.data(), voltage_V);
}

// Up to twelve curves, evenly spread over the irradiances; most curves of a sunny day are alike.
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

struct Extent {
  double low = 0;
  double high = 0;
  void Add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  // Lower end of an axis: 0 if only noise of its first points is below 0.
  double AxisBegin() const {
    constexpr double kScatter = 0.02;
    return low < -kScatter * high ? kUnknown : 0;
  }
};

// Points coloured by temperature.
Series Points(int symbol, double size) { return {SeriesKind::kPoints, {"", 1, symbol}, 1, size}; }

Panel CurvesPanel(const FamilyReport& report, const CurveSet& set) {
  CurveOf sources;
  for (const IvCurve& curve : set.curves) sources[curve.name] = &curve;
  Series measured = Points(6, 0.7);
  Series model{SeriesKind::kLine, {""}, 1.6};
  Extent voltage, current;
  for (const FamilyCurve* curve : Drawn(report, sources)) {
    const IvCurve& points = *sources.at(curve->id);
    for (std::size_t i = 0; i < points.size(); ++i) {
      measured.Add(points.voltage_V[i], points.current_A[i], curve->temperature_C);
      voltage.Add(points.voltage_V[i]);
      current.Add(points.current_A[i]);
    }
    measured.EndLine();
    const auto [low, high] = std::minmax_element(points.voltage_V.begin(), points.voltage_V.end());
    std::vector<double> voltage_V(kFamilyModelPoints);
    for (int i = 0; i < kFamilyModelPoints; ++i) {
      voltage_V[i] = *low + (*high - *low) * i / (kFamilyModelPoints - 1);
    }
    const std::vector<double> current_A = ModelCurrents(report, *curve, voltage_V);
    for (std::size_t i = 0; i < current_A.size(); ++i) {
      model.Add(voltage_V[i], current_A[i], curve->temperature_C);
    }
    model.EndLine();
  }
  Panel panel{"Measured points and model",
              {"Voltage (V)", voltage.AxisBegin()},
              {"Current (A)", current.AxisBegin()}};
  panel.series = {std::move(measured), std::move(model)};
  return panel;
}

// One value of each curve over its irradiance. Fitted curves are filled and drawn above the open
// validation curves.
template <typename Value>
Panel PerCurvePanel(const FamilyReport& report, const std::string& title, const Value& value) {
  Series held_out = Points(6, 1.2);
  Series fitted = Points(7, 1.2);
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role == CurveRole::kLeftOut) continue;
    (curve.role == CurveRole::kHeldOut ? held_out : fitted)
        .Add(curve.irradiance_W_m2, value(curve), curve.temperature_C);
  }
  Panel panel{title, {"Irradiance (W/m2)"}};
  panel.x.air_low = panel.x.air_high = 0.04;
  panel.y.air_high = 0.06;
  panel.series = {std::move(held_out), std::move(fitted)};
  return panel;
}

ColourBar TemperatureBar(const FamilyReport& report) {
  double coldest_C = 1e9, hottest_C = -1e9;
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role == CurveRole::kLeftOut) continue;
    coldest_C = std::min(coldest_C, curve.temperature_C);
    hottest_C = std::max(hottest_C, curve.temperature_C);
  }
  const double air = hottest_C - coldest_C > 0.5 ? 0 : 1;
  return {"Cell temperature (C)", coldest_C - air, hottest_C + air};
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

// Errors of Pmp of every condition in percent of Pmp at 1000 W/m2 and 25 C: by the fit, and by a
// fit that did not see the condition.
Panel PowerErrorPanel(const FamilyReport& report) {
  const double nominal_W = report.key_points->reference_power_W;
  const auto percent = [&](const FamilyCurve& curve, double power_W) {
    return 100 * (power_W - curve.key_points->measured.max_power_W) / nominal_W;
  };
  Panel panel = PerCurvePanel(
      report, "Pmp, model - measured (% of nominal; open: held out)",
      [&](const FamilyCurve& curve) {
        return curve.key_points ? percent(curve, curve.key_points->model.max_power_W) : kUnknown;
      });
  for (const FamilyCurve& curve : report.curves) {
    if (!curve.key_points || std::isnan(curve.key_points->held_out_power_W.value)) continue;
    panel.series.front().Add(curve.irradiance_W_m2,
                             percent(curve, curve.key_points->held_out_power_W.value),
                             curve.temperature_C);
  }
  panel.y.air_low = 0.06;
  panel.zero_line = true;
  return panel;
}

// Errors of Isc and Voc of every condition in percent.
Panel KeyPointPanel(const FamilyReport& report, const std::string& title,
                    double KeyPoints::*point) {
  Panel panel = PerCurvePanel(report, title, [&](const FamilyCurve& curve) {
    if (!curve.key_points) return kUnknown;
    return 100 * (curve.key_points->model.*point / curve.key_points->measured.*point - 1);
  });
  panel.y.air_low = 0.06;
  panel.zero_line = true;
  return panel;
}

Figure KeyPointFigure(const FamilyReport& report, const CurveSet& set) {
  Figure figure{fmt::format("{}: {} {}, rms error of Pmp {} % of nominal", report.name,
                            ToText(report.translation.spec.law),
                            ToText(report.translation.spec.model),
                            Significant(100 * report.key_points->max_power_of_reference, 2))};
  figure.panels = {
      CurvesPanel(report, set), PowerErrorPanel(report),
      KeyPointPanel(report, "Voc, model - measured (%)", &KeyPoints::open_circuit_voltage_V)};
  figure.columns = 3;
  figure.colour_bar = TemperatureBar(report);
  return figure;
}

}  // namespace

Figure FamilyFigure(const FamilyReport& report, const CurveSet& set) {
  if (report.key_points) return KeyPointFigure(report, set);
  const bool held_out =
      std::any_of(report.curves.begin(), report.curves.end(),
                  [](const FamilyCurve& curve) { return curve.role == CurveRole::kHeldOut; });
  const std::string open = held_out ? "; open: held out)" : ")";
  Panel rmse = PerCurvePanel(
      report, "RMSE of each curve (mA, solved-current" + open, [&](const FamilyCurve& curve) {
        const RmsePair& pair = report.estimates.empty() ? curve.individual_rmse : curve.rmse;
        return 1e3 * pair.solved_current_A;
      });
  rmse.y.low = 0;
  Panel mean = PerCurvePanel(report, "Mean of model - measured (mA" + open,
                             [](const FamilyCurve& curve) { return 1e3 * curve.mean_residual_A; });
  mean.y.air_low = 0.06;
  mean.zero_line = true;

  Figure figure{Title(report)};
  figure.panels = {CurvesPanel(report, set), std::move(rmse), std::move(mean)};
  figure.columns = 3;
  figure.colour_bar = TemperatureBar(report);
  return figure;
}

Expected<void> PlotFamily(const FamilyReport& report, const CurveSet& set, const std::string& path,
                          PlotPoints points) {
  return DrawFigure(FamilyFigure(report, set), path, points);
}

block::Figure FigureBlock(const FamilyReport& report, const CurveSet& set) {
  block::Figure shown;
  if (report.curves.empty() || set.curves.empty()) return shown;
  shown.caption = fmt::format(
      "Measured points and model of up to twelve curves spread over the irradiances; beside them, "
      "over irradiance, {}. The colour is the cell temperature.",
      report.key_points ? "the errors of Pmp and Voc under each condition"
                        : "the RMSE of each curve and its mean residual");
  shown.figure = FamilyFigure(report, set);
  block::Table table = {"lrrrrr",
                        {{"curve", "irradiance (W/m2)", "temperature (C)", "points",
                          "solved-current RMSE (A)", "mean residual (A)"}}};
  table.caption = "The curves.";
  for (const FamilyCurve& curve : report.curves) {
    table.rows.push_back({curve.id, Significant(curve.irradiance_W_m2, 4),
                          Significant(curve.temperature_C, 4), std::to_string(curve.points),
                          Scientific(curve.rmse.solved_current_A, 3),
                          Significant(curve.mean_residual_A, 3)});
  }
  shown.readings = std::move(table);
  return shown;
}

}  // namespace lyrefit
