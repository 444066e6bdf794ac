#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "lyrefit/devices/data_sheet.h"
#include "lyrefit/devices/data_sheet_parts.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr int kSheetPlotPoints = 150;
constexpr double kLowestIsDrawn_A = 1e-25;
constexpr double kMostPowerDrawn = 0.25;  // relative to the selected member's power
constexpr char kGreen[] = "#009E73";

const Look kKneeLook = {kGrey, 2};
const Look kHalfLook = {kVermilion};
const Look kPickedLook = {"#000000"};
const Look kLastLook = {kBlue};

// Key points that the three points of a data sheet fix.
struct ThreePoints {
  double isc_A, voc_V, imp_A, vmp_V;
};

ThreePoints PointsOf(const DataSheetFit& fit) {
  return {fit.checks[0].given, fit.checks[1].given, fit.checks[2].given, fit.checks[3].given};
}

std::vector<double> VoltagesOf(const ThreePoints& at) {
  std::vector<double> voltage_V = {at.vmp_V};
  for (int k = 0; k <= kSheetPlotPoints; ++k) {
    voltage_V.push_back(at.voc_V * k / kSheetPlotPoints);
  }
  std::sort(voltage_V.begin(), voltage_V.end());
  return voltage_V;
}

std::vector<double> KneeCurrents(const ThreePoints& at, const std::vector<double>& voltage_V) {
  std::vector<double> current_A;
  current_A.reserve(voltage_V.size());
  for (const double v : voltage_V) {
    current_A.push_back(v < at.vmp_V ? at.isc_A - (at.isc_A - at.imp_A) * v / at.vmp_V
                                     : at.imp_A * (at.voc_V - v) / (at.voc_V - at.vmp_V));
  }
  return current_A;
}

std::vector<double> MemberCurrents(const DataSheetFit& fit, const DataSheetMember& member,
                                   const std::vector<double>& voltage_V) {
  const TranslatedDevice at = TranslateTo(fit.translation, SharedOf(fit, member),
                                          kReferenceIrradiance_W_m2, kReferenceTemperature_K);
  std::vector<double> current_A;
  current_A.reserve(voltage_V.size());
  for (const double v : voltage_V) {
    current_A.push_back(SolveOperatingPoint(at.device, at.parameters.data(), v).current_A);
  }
  return current_A;
}

const DataSheetMember& HalfWay(const DataSheetFamily& family) {
  return family.members[family.members.size() / 2 - 1];
}

std::string LastLegend(const DataSheetFamily& family) {
  return fmt::format("n = {}: {} = 0", Significant(family.members.back().n, 3),
                     family.bound == FamilyBound::kSeriesResistance ? "Rs" : "1/Rsh");
}

// The panels over voltage: currents of members, and their differences from the selected member's.
std::vector<Panel> CurvePanels(const DataSheetFit& fit) {
  const DataSheetFamily& family = fit.family;
  const ThreePoints at = PointsOf(fit);
  const std::vector<double> voltage_V = VoltagesOf(at);
  const std::vector<double> own_A = MemberCurrents(fit, *family.picked, voltage_V);
  Panel curves{"All these pass through the three points", {"Voltage (V)", 0}, {"Current (A)", 0}};
  Panel apart{"Current minus that of the picked device (% of Isc)", {"Voltage (V)", 0}};
  apart.zero_line = true;
  const auto add = [&](const std::vector<double>& current_A, const Look& look, double width) {
    Series curve{SeriesKind::kLine, look, width}, difference{SeriesKind::kLine, look, width};
    for (std::size_t k = 0; k < voltage_V.size(); ++k) {
      curve.Add(voltage_V[k], current_A[k]);
      difference.Add(voltage_V[k], 100 * (current_A[k] - own_A[k]) / at.isc_A);
    }
    curves.series.push_back(std::move(curve));
    apart.series.push_back(std::move(difference));
  };
  add(KneeCurrents(at, voltage_V), kKneeLook, 1.6);
  add(MemberCurrents(fit, HalfWay(family), voltage_V), kHalfLook, 1.6);
  add(MemberCurrents(fit, family.members.back(), voltage_V), kLastLook, 1.6);
  add(own_A, kPickedLook, 2);
  Series points{SeriesKind::kPoints, {"#000000", 1, 6}, 1.6, 1.6};
  Series zeros = points;
  for (const auto& [v, i] : {std::pair{0.0, at.isc_A}, {at.vmp_V, at.imp_A}, {at.voc_V, 0.0}}) {
    points.Add(v, i);
    zeros.Add(v, 0);
  }
  curves.series.push_back(std::move(points));
  apart.series.push_back(std::move(zeros));
  curves.x.high = apart.x.high = 1.04 * at.voc_V;
  curves.y.high = 1.06 * at.isc_A;
  return {std::move(curves), std::move(apart)};
}

// A panel over n with a band for the n allowed by rounding.
Panel OverIdeality(const DataSheetFit& fit, const std::string& title, const std::string& label) {
  const DataSheetFamily& family = fit.family;
  Panel panel{title, {"Ideality factor n", 0, 1.04 * family.members.back().n}, {label}};
  if (family.rounding_low && family.rounding_high) {
    panel.bands = {{true, family.rounding_low->n, family.rounding_high->n}};
  }
  return panel;
}

// One value of each member as a line, with a disc for the selected member and a ring for the limit
// at n = 0 if known.
template <class F>
void AddMembers(const DataSheetFit& fit, const F& value, const Look& look, bool right_axis,
                Panel* panel, double at_zero = kUnknown) {
  Series line{SeriesKind::kLine, look, 1.8};
  Series disc{SeriesKind::kPoints, {look.colour, 1, 7}, 1, 1.6};
  Series ring{SeriesKind::kPoints, {look.colour, 1, 6}, 1.6, 1.6};
  line.right_axis = disc.right_axis = ring.right_axis = right_axis;
  ring.Add(0, at_zero);
  for (const DataSheetMember& member : fit.family.members) line.Add(member.n, value(member));
  disc.Add(fit.family.picked->n, value(*fit.family.picked));
  panel->series.push_back(std::move(line));
  panel->series.push_back(std::move(disc));
  panel->series.push_back(std::move(ring));
}

Look PowerLook(std::size_t condition) {
  constexpr const char* kColours[] = {kGreen, kOrange, "#CC79A7"};
  return {kColours[condition % std::size(kColours)]};
}

Panel PowerPanel(const DataSheetFit& fit) {
  const DataSheetFamily& family = fit.family;
  Panel panel = OverIdeality(fit, "Power against the picked device (%)", "");
  panel.zero_line = true;
  for (std::size_t k = 0; k < family.conditions.size(); ++k) {
    const double own_W = family.picked->max_power_W[k];
    const auto change = [k, own_W](const DataSheetMember& member) {
      const double part = member.max_power_W[k] / own_W - 1;
      return std::fabs(part) < kMostPowerDrawn ? 100 * part : kUnknown;
    };
    AddMembers(fit, change, PowerLook(k), false, &panel);
  }
  return panel;
}

std::vector<Panel> ParameterPanels(const DataSheetFit& fit) {
  Panel beta = OverIdeality(fit, "Coefficient of Voc; the sheet's is dotted", "beta_oc (V/K)");
  AddMembers(
      fit, [](const DataSheetMember& m) { return m.beta_oc_V_K; }, kPickedLook, false, &beta);
  beta.rules = {{fit.checks[4].asked, kGrey, 3, 1.4}};
  Panel diode = OverIdeality(fit, "Saturation current Is (A)", "");
  diode.y.log = true;
  AddMembers(
      fit,
      [](const DataSheetMember& m) {
        return m.saturation_current_A > kLowestIsDrawn_A ? m.saturation_current_A : kUnknown;
      },
      kPickedLook, false, &diode);
  Panel ohms = OverIdeality(fit, "Rs (ohm, left) and 1/Rsh (mS, right)", "");
  ohms.right = Axis{"1/Rsh (mS)", 0};
  ohms.right->colour = kVermilion;
  ohms.y.low = 0;
  const SharpKnee& knee = fit.family.sharp_knee;
  const auto rs = [](const DataSheetMember& m) { return m.resistance_series_ohm; };
  const auto shunt = [](const DataSheetMember& m) { return 1e3 / m.resistance_shunt_ohm; };
  AddMembers(fit, rs, {kBlue}, false, &ohms, knee.resistance_series_ohm);
  AddMembers(fit, shunt, {kVermilion, 2}, true, &ohms, 1e3 / knee.resistance_shunt_ohm);
  return {std::move(beta), std::move(diode), std::move(ohms)};
}

}  // namespace

Figure DataSheetFigure(const DataSheetFit& fit) {
  const DataSheetFamily& family = fit.family;
  Figure figure;
  if (family.members.size() < 2 || !family.picked || fit.checks.size() < 5) return figure;
  figure.title =
      fmt::format("All devices of one data sheet: n is left over, and beta_oc picks n = {}",
                  Significant(family.picked->n, 4));
  figure.legend = {{"towards n = 0", kKneeLook},
                   {fmt::format("n = {}", Significant(HalfWay(family).n, 3)), kHalfLook},
                   {fmt::format("n = {}: picked", Significant(family.picked->n, 3)), kPickedLook},
                   {LastLegend(family), kLastLook}};
  for (std::size_t k = 0; k < family.conditions.size(); ++k) {
    figure.legend.push_back({"Pmax at " + ConditionsText(family.conditions[k]), PowerLook(k)});
  }
  if (family.rounding_low) {
    figure.legend.push_back({"n of the rounding", {kSkyBlue}, LegendMark::kBox});
  }
  figure.panels = CurvePanels(fit);
  figure.panels.push_back(PowerPanel(fit));
  for (Panel& panel : ParameterPanels(fit)) figure.panels.push_back(std::move(panel));
  figure.columns = 3;
  return figure;
}

Expected<void> PlotDataSheet(const DataSheetFit& fit, const std::string& path) {
  return DrawFigure(DataSheetFigure(fit), path);
}

block::Figure FigureBlock(const DataSheetFit& fit) {
  block::Figure shown;
  shown.figure = DataSheetFigure(fit);
  if (shown.figure.panels.empty()) return shown;
  shown.caption = fmt::format(
      "Devices through the sheet's three points, one for every n: their curves and how far they "
      "are from that of the picked one, what De Soto's law makes of their power, and over n the "
      "coefficient of Voc, which picks one, and the parameters. Any two curves are at most {} A "
      "apart, {} % of Isc.",
      Significant(fit.family.spread.difference_A, 3),
      Significant(fit.family.spread.difference_percent, 3));
  shown.readings = MemberTable(fit);
  return shown;
}

}  // namespace lyrefit
