#include <fmt/format.h>

#include <cmath>

#include "lyrefit/certify/certify.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"
#include "lyrefit/report/text_sections.h"

namespace lyrefit {
namespace {

constexpr int kSearchedDigits = 5;
constexpr int kValueDigits = 6;
constexpr int kErrorDigits = 2;
constexpr int kRmseDigits = 10;
constexpr double kLargestPercent = 1000;  // beyond it a relative difference says nothing

std::vector<std::string> ParameterRow(const Estimate& e, bool polished) {
  return {LabelWithUnit(e.info),
          Significant(e.searched, kSearchedDigits),
          polished ? Significant(e.refined, kValueDigits) : "-",
          Significant(e.standard_error, kErrorDigits),
          Range(e.low_95, e.high_95),
          EstimateMarks(e)};
}

// "95 % intervals: profile (Rs, n2), symmetric (Iph)".
std::string IntervalNote(const std::vector<Estimate>& estimates) {
  std::string note;
  for (const IntervalMethod method :
       {IntervalMethod::kSymmetric, IntervalMethod::kProfile, IntervalMethod::kUnsettled}) {
    std::string symbols;
    for (const Estimate& e : estimates) {
      if (e.interval == method) symbols += (symbols.empty() ? "" : ", ") + e.info.symbol;
    }
    if (symbols.empty()) continue;
    note += fmt::format("{}{} ({})", note.empty() ? "" : "; ", ToText(method), symbols);
  }
  return note;
}

std::string Difference(double measured, double simulated) {
  const double percent = 100 * (simulated / measured - 1);
  return std::abs(percent) < kLargestPercent ? fmt::format("{:+.3f} %", percent) : "-";
}

// How much room is left below, if that was asked for.
std::string FloorNote(const FitReport& report) {
  if (!report.floor) return "";
  const FloorReport& floor = *report.floor;
  const std::string range = fmt::format("n in [{:g}, {:g}]", floor.n_lower, floor.n_upper);
  const std::string above = floor.above <= kCertifiedGap
                                ? "and the refined answer attains it"
                                : fmt::format("and the refined answer is {} % above it",
                                              Significant(100 * floor.above, 3));
  return Wrap("  ", fmt::format("Floor: no number of diodes with {} brings the measured-current "
                                "RMSE below {} A, {}.",
                                range, BoundText(floor.lower_bound_A), above));
}

}  // namespace

std::string ParameterSection(const FitReport& report) {
  TextTable table("lrrrll");
  table.Add({"parameter", "searched", "refined", "std err", "95 % interval"});
  for (const Estimate& e : report.estimates) table.Add(ParameterRow(e, report.polished));
  std::string text = "Parameters\n" + table.Text();
  if (!report.polished)
    text += Wrap("  ", "No polish was done: the searched values are the answer.");
  text += UnidentifiableNotes(report.estimates);
  const std::string intervals = IntervalNote(report.estimates);
  if (!intervals.empty()) text += Wrap("  ", "95 % intervals: " + intervals);
  if (!report.no_intervals_because.empty()) {
    text += Wrap("  ", "95 % intervals: none, since " + report.no_intervals_because + ".");
  }
  text += Wrap("  ", fmt::format("nNsVth = {} V (n1 x cells in series x k T / q)",
                                 Significant(report.nNsVth, kValueDigits)));
  return text;
}

// The three sizes in words, and what they are good for.
std::string ErrorSection(const FitReport& report) {
  if (!report.errors) return "";
  const ErrorReport& errors = *report.errors;
  std::string text = "Errors of the readings\n" + ErrorSizesText(errors);
  if (!report.under_errors.empty()) {
    TextTable table("lrl");
    table.Add({"parameter", "std err", "95 % interval under these errors"});
    for (const Estimate& e : report.under_errors) {
      table.Add({LabelWithUnit(e.info), Significant(e.standard_error, kErrorDigits),
                 Range(e.low_95, e.high_95)});
    }
    text += table.Text();
    text += Wrap("  ", "95 % intervals: " + IntervalNote(report.under_errors));
  }
  return text + Wrap("  ", WhichToBelieve(errors));
}

std::string RmseSection(const FitReport& report) {
  const auto label = [&](Objective objective) {
    return ToText(objective) + (objective == report.objective ? " *" : "");
  };
  const auto row = [](const char* name, const RmsePair& rmse, bool known) {
    const RmsePair shown = known ? rmse : RmsePair{};
    return std::vector<std::string>{name, Scientific(shown.measured_current_A, kRmseDigits),
                                    Scientific(shown.solved_current_A, kRmseDigits)};
  };
  TextTable table("lrr");
  table.Add({"", label(Objective::kMeasuredCurrent), label(Objective::kSolvedCurrent)});
  table.Add(row("random points, as many", report.rmse.random_baseline, true));
  table.Add(row("searched (best bird)", report.rmse.searched, true));
  table.Add(row("best bird polished", report.rmse.best_bird_polished, report.polished));
  const bool weighed = report.errors && report.errors->weighed;
  if (weighed) table.Add(row("least squares", report.errors->least_squares, true));
  table.Add(row(weighed ? "weighed by the errors" : "refined (best of all starts)",
                report.rmse.refined, report.polished));
  const std::string note =
      weighed ? Wrap("  ", "The answer is weighed by the errors: its plain RMSE is not the lowest.")
              : "";
  return "RMSE in A   (* the objective that was fitted)\n" + table.Text() + note +
         FloorNote(report);
}

std::string KeyPointSection(const FitReport& report) {
  const struct {
    const char* name;
    const char* unit;
    double KeyPoints::*field;
  } rows[] = {{"Isc", "A", &KeyPoints::short_circuit_current_A},
              {"Voc", "V", &KeyPoints::open_circuit_voltage_V},
              {"Vmp", "V", &KeyPoints::max_power_voltage_V},
              {"Imp", "A", &KeyPoints::max_power_current_A},
              {"Pmp", "W", &KeyPoints::max_power_W},
              {"fill factor", "", &KeyPoints::fill_factor}};
  TextTable table("lrrrl");
  table.Add({"", "measured", "simulated", "difference", "unit"});
  for (const auto& row : rows) {
    const double measured = report.measured.*row.field;
    const double simulated = report.simulated.*row.field;
    table.Add({row.name, Significant(measured, kValueDigits), Significant(simulated, kValueDigits),
               Difference(measured, simulated), row.unit});
  }
  return "Key points\n" + table.Text();
}

}  // namespace lyrefit
