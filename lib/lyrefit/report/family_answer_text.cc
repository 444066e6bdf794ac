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

std::string Percent(double part) { return Significant(100 * part, 2) + " %"; }

// What hangs together in the errors, in a sentence each.
std::string FamilyErrorText(const FamilyReport& report) {
  if (!report.errors) return "";
  const FamilyErrors& errors = *report.errors;
  const std::string by =
      errors.judge == FamilyErrorJudge::kHeldOut
          ? fmt::format("{} that were not fitted say", Plural(errors.tested_curves, "curve"))
      : errors.judge == FamilyErrorJudge::kHalves
          ? fmt::format("{}, each half under the errors of the other half, say",
                        Plural(errors.tested_curves, "curve"))
          : "the fitted curves say";
  if (errors.kind == FamilyErrorKind::kIndependent) {
    return Wrap("  ", fmt::format("Errors of the readings: {} that they are independent of each "
                                  "other.",
                                  by));
  }
  const FamilyErrorSizes& sizes = errors.sizes;
  std::string shared = fmt::format(
      "a path of {} of Isc along the brightest curve (light that wanders, or what the model "
      "misses; "
      "{} light)",
      Percent(sizes.readings.path),
      errors.path_power == 1     ? "in proportion to"
      : errors.path_power == 0.5 ? "growing with the root of the"
                                 : "of one size at every");
  if (errors.kind == FamilyErrorKind::kCurves) {
    shared += fmt::format(", the stated light of a curve wrong by {}, its temperature by {} K",
                          Percent(sizes.irradiance), Significant(sizes.temperature_K, 2));
  }
  return Wrap("  ",
              fmt::format("Errors of the readings: {} A of a current, {} V of a voltage at Voc, "
                          "and beside these {}; {} so. Believe intervals of points with these "
                          "errors, or of whole curves, not those of independent points.",
                          Significant(sizes.readings.current_A, 2),
                          Significant(sizes.readings.voltage_V, 2), shared, by));
}

// What the shared intervals are when something else than independent points varies.
std::string OtherIntervals(const FamilyReport& report) {
  const std::size_t count = report.estimates.size();
  const bool jackknife = report.jackknife.size() == count;
  const bool under = report.under_errors.size() == count;
  if (!jackknife && !under) return FamilyErrorText(report);
  const auto row = [&](const std::string& label, const std::string& points,
                       const std::string& with_errors, const std::string& curves) {
    std::vector<std::string> cells = {label, points};
    if (under) cells.push_back(with_errors);
    if (jackknife) cells.push_back(curves);
    return cells;
  };
  const auto range = [](const std::vector<Interval>& intervals, std::size_t i) {
    return i < intervals.size() ? Range(intervals[i].low_95, intervals[i].high_95) : "";
  };
  TextTable table(under && jackknife ? "llll" : "lll");
  table.Add(row("", "points", "points with errors", "whole curves"));
  for (std::size_t i = 0; i < count; ++i) {
    const Estimate& e = report.estimates[i];
    if (e.fixed) continue;
    table.Add(row(LabelWithUnit(e.info), Range(e.low_95, e.high_95), range(report.under_errors, i),
                  range(report.jackknife, i)));
  }
  const std::string what = std::string("95 % intervals, with independent points") +
                           (under ? ", points with the errors below" : "") +
                           (jackknife ? " and whole curves (each left out in turn)" : "") +
                           " as what varies:";
  return Wrap("  ", what) + table.Text() + FamilyErrorText(report);
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
  text += OtherIntervals(report);
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
