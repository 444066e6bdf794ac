#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kFamilySearchedDigits = 4;
constexpr int kFamilyValueDigits = 6;
constexpr int kFamilyRmseDigits = 7;

bool Known(const Interval& interval) { return !std::isnan(interval.value); }

// "-0.31 K, 95 % -0.35 .. -0.27"
std::string WithRange(const Interval& interval, const std::string& unit) {
  std::string text = Significant(interval.value, 4) + " " + unit;
  if (!std::isnan(interval.low_95)) {
    text += fmt::format(", 95 % {}", Range(interval.low_95, interval.high_95));
  }
  return text;
}

std::string JackknifeTable(const FamilyReport& report) {
  if (report.jackknife.size() != report.estimates.size()) return "";
  TextTable table("lll");
  table.Add({"", "points", "whole curves"});
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    const Estimate& e = report.estimates[i];
    if (e.fixed) continue;
    const Interval& jackknife = report.jackknife[i];
    table.Add({LabelWithUnit(e.info), Range(e.low_95, e.high_95),
               Range(jackknife.low_95, jackknife.high_95)});
  }
  return Wrap("  ",
              "95 % intervals, with points and with whole curves (each left out in turn) as what "
              "varies independently:") +
         table.Text();
}

}  // namespace

std::string FamilyParameterSection(const FamilyReport& report) {
  if (OneByOne(report)) return "";
  TextTable table("llrrll");
  table.Add({"parameter", "name", "searched", "refined", "95 % interval"});
  for (const Estimate& e : report.estimates) {
    table.Add({LabelWithUnit(e.info), e.info.name, Significant(e.searched, kFamilySearchedDigits),
               Significant(e.refined, kFamilyValueDigits), Range(e.low_95, e.high_95),
               EstimateMarks(e)});
  }
  std::string text = "Shared parameters at 1000 W/m2 and 25 C\n" + table.Text();
  text += UnidentifiableNotes(report.estimates);
  text += JackknifeTable(report);
  const std::string correlations = CorrelationsText(report.correlations);
  if (!correlations.empty()) text += Field("correlations", correlations + " (above 0.9)");
  return text;
}

std::string FamilySensorSection(const FamilyReport& report) {
  const Interval& irradiance = report.irradiance_offset_W_m2;
  const Interval& temperature = report.temperature_offset_K;
  if (!Known(irradiance) && !Known(temperature)) return "";
  std::string text = "Error of the sensors, common to all curves (true = reading + offset)\n";
  if (Known(irradiance)) text += Field("irradiance", WithRange(irradiance, "W/m2"));
  if (Known(temperature)) text += Field("temperature", WithRange(temperature, "K"));
  return text;
}

std::string FamilyReferenceSection(const FamilyReport& report) {
  if (OneByOne(report)) return "";
  const KeyPoints& k = report.reference;
  std::string text = "The model at 1000 W/m2 and 25 C\n";
  text += Field(
      "key points",
      fmt::format("Isc {} A, Voc {} V, Imp {} A, Vmp {} V, Pmp {} W, fill factor {}",
                  Significant(k.short_circuit_current_A, kFamilyValueDigits),
                  Significant(k.open_circuit_voltage_V, kFamilyValueDigits),
                  Significant(k.max_power_current_A, kFamilyValueDigits),
                  Significant(k.max_power_voltage_V, kFamilyValueDigits),
                  Significant(k.max_power_W, kFamilyValueDigits), Significant(k.fill_factor, 4)));
  if (!report.with.empty()) text += Wrap("  ", "Temperature coefficients, without the effects:");
  for (const Coefficient& c : report.coefficients) {
    text += Field(c.name, WithRange(c.value, c.unit));
  }
  return text;
}

std::string FamilyRmseSection(const FamilyReport& report) {
  if (OneByOne(report)) return "";
  const auto label = [&](Objective objective) {
    return ToText(objective) + (objective == report.objective ? " *" : "");
  };
  TextTable table("lrrl");
  const auto add = [&](const char* name, const RmsePair& rmse, const std::string& over) {
    table.Add({name, Scientific(rmse.measured_current_A, kFamilyRmseDigits),
               Scientific(rmse.solved_current_A, kFamilyRmseDigits), over});
  };
  std::size_t fitted = 0;
  for (const FamilyCurve& curve : report.curves) fitted += curve.role == CurveRole::kFitted;
  const std::string seen =
      fmt::format("the {} of the search", Plural(report.search_ids.size(), "curve"));
  const std::string all = fmt::format("all {} fitted", Plural(fitted, "curve"));
  table.Add({"", label(Objective::kMeasuredCurrent), label(Objective::kSolvedCurrent), "over"});
  add("random points, as many", report.rmse.random_baseline, seen);
  add("searched (best bird)", report.rmse.searched, seen);
  add("searched (best bird)", report.rmse.searched_all, all);
  add("refined", report.rmse.refined, all);
  std::string text = "RMSE in A   (* the objective that was fitted)\n" + table.Text();
  if (!std::isnan(report.noise_A)) {
    text += Field("noise", Significant(report.noise_A, 4) + " A, residual standard deviation");
  }
  return text;
}

}  // namespace lyrefit
