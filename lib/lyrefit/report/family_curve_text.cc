#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostRows = 40;
constexpr std::size_t kWorstRows = 10;
constexpr std::size_t kLongestId = 16;

double ErrorOf(const FamilyReport& report, const FamilyCurve& curve) {
  return (OneByOne(report) ? curve.free_rmse : curve.rmse).Of(report.objective);
}

// The curves that the tables show: all of them, or the worst of too many.
std::vector<const FamilyCurve*> Shown(const FamilyReport& report) {
  std::vector<const FamilyCurve*> shown;
  for (const FamilyCurve& curve : report.curves) shown.push_back(&curve);
  if (shown.size() <= kMostRows) return shown;
  shown.erase(
      std::remove_if(shown.begin(), shown.end(),
                     [&](const FamilyCurve* curve) { return std::isnan(ErrorOf(report, *curve)); }),
      shown.end());
  std::stable_sort(shown.begin(), shown.end(), [&](const FamilyCurve* a, const FamilyCurve* b) {
    return ErrorOf(report, *a) > ErrorOf(report, *b);
  });
  if (shown.size() > kWorstRows) shown.resize(kWorstRows);
  return shown;
}

// Where the other curves are.
std::string OthersNote(const FamilyReport& report, std::size_t shown) {
  if (shown == report.curves.size()) return "";
  return Wrap("  ", fmt::format("These are the worst {} of {} curves by {} RMSE; all are in the "
                                "JSON report (--json FILE).",
                                shown, report.curves.size(), ToText(report.objective)));
}

// An id that leaves room for the other columns.
std::string ShortId(const std::string& id) {
  if (id.size() <= kLongestId) return id;
  const std::size_t half = (kLongestId - 2) / 2;
  return id.substr(0, half) + ".." + id.substr(id.size() - half);
}

// "1000.5", "1000?" where nobody stated it
std::string Stated(double value, bool known) {
  return fmt::format("{:.5g}{}", value, known ? "" : "?");
}

std::string Signed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:+.{}f}", value, decimals) : "-";
}

std::string Marks(const FamilyCurve& curve) {
  if (curve.role == CurveRole::kFitted) return curve.odd ? "odd" : "";
  if (curve.odd) return "odd, out";
  return curve.role == CurveRole::kHeldOut ? "held out" : "left out";
}

std::string WithError(const Interval& interval, int digits) {
  if (std::isnan(interval.value)) return "-";
  return fmt::format("{} .. {} .. {}", Significant(interval.low_95, digits),
                     Significant(interval.value, digits), Significant(interval.high_95, digits));
}

bool HasOffset(const FamilyCurve& curve) {
  return !std::isnan(curve.irradiance_offset_W_m2.value) ||
         !std::isnan(curve.temperature_offset_K.value);
}

}  // namespace

std::string FamilyCurveSection(const FamilyReport& report) {
  if (OneByOne(report) || report.curves.empty()) return "";
  const double isc = report.reference.short_circuit_current_A;
  TextTable table("lrrrrrrrrl");
  table.Add({"", "G", "T", "RMSE (A)", "RMSE (A)", "of Isc", "free fit", "Isc off", "Voc off", ""});
  table.Add({"curve", "W/m2", "C", "measured", "solved", "%", "solved", "%", "V", ""});
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    const double percent = 100 * curve->rmse.solved_current_A / isc;
    table.Add({ShortId(curve->id), Stated(curve->irradiance_W_m2, curve->irradiance_known),
               Stated(curve->temperature_C, curve->temperature_known),
               Scientific(curve->rmse.measured_current_A, 3),
               Scientific(curve->rmse.solved_current_A, 3),
               std::isfinite(percent) ? fmt::format("{:.3f}", percent) : "-",
               Scientific(curve->free_rmse.solved_current_A, 3), Signed(100 * curve->isc_excess, 2),
               Signed(curve->voc_excess_V, 3), Marks(*curve)});
  }
  return "Curves\n" + table.Text() + OthersNote(report, shown.size()) +
         Wrap("  ",
              "measured: measured-current RMSE, solved: solved-current RMSE; %: solved-current "
              "RMSE as a part of the Isc that the model has at 1000 W/m2 and 25 C; free fit: the "
              "curve on its own; off: its own Isc and Voc less those of the model - Isc off speaks "
              "of the irradiance, Voc off alone of the temperature; ?: nobody stated it");
}

std::string FamilyOffsetSection(const FamilyReport& report) {
  if (OneByOne(report)) return "";
  TextTable table("lll");
  table.Add({"curve", "irradiance (W/m2)", "temperature (K)"});
  bool any = false;
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    if (!HasOffset(*curve)) continue;
    any = true;
    table.Add({ShortId(curve->id), WithError(curve->irradiance_offset_W_m2, 4),
               WithError(curve->temperature_offset_K, 4)});
  }
  if (!any) return "";
  return "What the fit adds to the stated conditions (95 % from .. value .. to)\n" + table.Text() +
         OthersNote(report, shown.size());
}

std::string FreeFitSection(const FamilyReport& report) {
  if (!OneByOne(report) || report.curves.empty()) return "";
  const bool two = report.translation.spec.model == Model::kDoubleDiode;
  const std::vector<ParameterInfo> infos = FreeInfos(report);
  const std::size_t count = infos.size();
  const int digits = two ? 3 : 4;
  TextTable table("lrrr" + std::string(count, 'r'));
  std::vector<std::string> head = {"", "G", "T", "RMSE"};
  std::vector<std::string> below = {"curve", "W/m2", "C", "A"};
  for (const ParameterInfo& info : infos) {
    head.push_back(info.symbol);
    below.push_back(info.unit);
  }
  table.Add(head);
  table.Add(below);
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    std::vector<std::string> row = {ShortId(curve->id),
                                    Stated(curve->irradiance_W_m2, curve->irradiance_known),
                                    Stated(curve->temperature_C, curve->temperature_known),
                                    Scientific(ErrorOf(report, *curve), two ? 3 : 4)};
    for (std::size_t i = 0; i < count; ++i) {
      row.push_back(
          i < curve->free_parameters.size() ? Significant(curve->free_parameters[i], digits) : "-");
    }
    table.Add(row);
  }
  return fmt::format("Curves, each fitted on its own (RMSE: {})\n", ToText(report.objective)) +
         table.Text() + OthersNote(report, shown.size());
}

}  // namespace lyrefit
