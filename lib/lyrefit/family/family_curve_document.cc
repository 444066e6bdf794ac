#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/text_layout.h"

namespace lyrefit {
namespace {

constexpr std::size_t kMostRows = 40;
constexpr std::size_t kWorstRows = 10;
constexpr std::size_t kLongestId = 16;
constexpr std::size_t kLongestFile = 24;  // of a file name
constexpr std::size_t kMostNamed = 10;    // curves in a list; the JSON report has all
constexpr int kHeldOutDigits = 4;

double ErrorOf(const FamilyReport& report, const FamilyCurve& curve) {
  return (OneByOne(report) ? curve.individual_rmse : curve.rmse).Of(report.objective);
}

// The curves of the tables: all, or the worst if there are too many.
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

// States where the other curves are reported.
void AddOthersNote(const FamilyReport& report, std::size_t shown, Section* section) {
  if (shown == report.curves.size()) return;
  AddSentence(fmt::format("These are the worst {} of {} curves by {} RMSE; all are in the JSON "
                          "report (--json FILE).",
                          shown, report.curves.size(), ToText(report.objective)),
              section);
}

// An id shortened in the middle to kLongestId.
std::string ShortId(const std::string& id) {
  if (id.size() <= kLongestId) return id;
  const std::size_t half = (kLongestId - 2) / 2;
  return id.substr(0, half) + ".." + id.substr(id.size() - half);
}

// A value with "?" if it was not stated: "1000.5", "1000?"
std::string Stated(double value, bool known) {
  return fmt::format("{:.5g}{}", value, known ? "" : "?");
}

std::string Signed(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:+.{}f}", value, decimals) : "-";
}

std::string PercentOfIsc(double rmse_A, double isc_A) {
  const double percent = 100 * rmse_A / isc_A;
  return std::isfinite(percent) ? fmt::format("{:.3f}", percent) : "-";
}

std::string Marks(const FamilyCurve& curve) {
  if (curve.role == CurveRole::kFitted) return curve.outlier ? "outlier" : "";
  if (curve.outlier) return "outlier";
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

Section CurveSection(const FamilyReport& report) {
  Section section = {"Curves"};
  if (OneByOne(report) || report.curves.empty() || report.key_points) return section;
  const double isc = report.reference.short_circuit_current_A;
  block::Table table = {
      "lrrrrrrrrl",
      {{"", "G", "T", "RMSE (A)", "RMSE (A)", "of Isc", "own fit", "Isc off", "Voc off", ""},
       {"curve", "W/m2", "C", "measured", "solved", "%", "solved", "%", "V", ""}}};
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    table.rows.push_back(
        {ShortId(curve->id), Stated(curve->irradiance_W_m2, curve->irradiance_known),
         Stated(curve->temperature_C, curve->temperature_known),
         Scientific(curve->rmse.measured_current_A, 3), Scientific(curve->rmse.solved_current_A, 3),
         PercentOfIsc(curve->rmse.solved_current_A, isc),
         Scientific(curve->individual_rmse.solved_current_A, 3), Signed(100 * curve->isc_excess, 2),
         Signed(curve->voc_excess_V, 3), Marks(*curve)});
  }
  AddTable(std::move(table), &section);
  AddOthersNote(report, shown.size(), &section);
  AddSentence(
      "measured: measured-current RMSE, solved: solved-current RMSE; %: solved-current RMSE as a "
      "part of the Isc that the model has at 1000 W/m2 and 25 C; own fit: the curve on its own; "
      "off: its own Isc and Voc less those of the model - Isc off speaks of the irradiance, Voc "
      "off alone of the temperature; ?: nobody stated it",
      &section);
  return section;
}

Section OffsetSection(const FamilyReport& report) {
  Section section = {"What the fit adds to the stated conditions (95 % from .. value .. to)"};
  if (OneByOne(report)) return section;
  block::Table table = {"lll", {{"curve", "irradiance (W/m2)", "temperature (K)"}}};
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    if (!HasOffset(*curve)) continue;
    table.rows.push_back({ShortId(curve->id), WithError(curve->irradiance_offset_W_m2, 4),
                          WithError(curve->temperature_offset_K, 4)});
  }
  if (table.rows.empty()) return section;
  AddTable(std::move(table), &section);
  AddOthersNote(report, shown.size(), &section);
  return section;
}

Section IndividualFitSection(const FamilyReport& report) {
  Section section = {
      fmt::format("Curves, each fitted on its own (RMSE: {})", ToText(report.objective))};
  if (!OneByOne(report) || report.curves.empty()) return section;
  const bool two = report.translation.spec.model == Model::kDoubleDiode;
  const std::vector<ParameterInfo> infos = FreeInfos(report);
  const int digits = two ? 3 : 4;
  block::Table table = {"lrrr" + std::string(infos.size(), 'r'),
                        {{"", "G", "T", "RMSE"}, {"curve", "W/m2", "C", "A"}}};
  for (const ParameterInfo& info : infos) {
    table.heads[0].push_back(info.symbol);
    table.heads[1].push_back(info.unit);
  }
  const std::vector<const FamilyCurve*> shown = Shown(report);
  for (const FamilyCurve* curve : shown) {
    const std::vector<double>& values = curve->individual_parameters;
    std::vector<std::string> row = {ShortId(curve->id),
                                    Stated(curve->irradiance_W_m2, curve->irradiance_known),
                                    Stated(curve->temperature_C, curve->temperature_known),
                                    Scientific(ErrorOf(report, *curve), two ? 3 : 4)};
    for (std::size_t i = 0; i < infos.size(); ++i) {
      row.push_back(i < values.size() ? Significant(values[i], digits) : "-");
    }
    table.rows.push_back(std::move(row));
  }
  AddTable(std::move(table), &section);
  AddOthersNote(report, shown.size(), &section);
  return section;
}

std::string Shortened(const std::string& name, std::size_t longest) {
  return name.size() <= longest ? name : name.substr(0, longest - 2) + "..";
}

block::Table::Row HeldOutRow(const std::string& name, const std::string& law, const HeldOut& test,
                             double isc_A) {
  return {Shortened(name, kLongestFile),
          law,
          Scientific(test.median_rmse_A, kHeldOutDigits),
          PercentOfIsc(test.median_rmse_A, isc_A),
          Scientific(test.rmse.solved_current_A, kHeldOutDigits),
          Scientific(test.largest_rmse_A, kHeldOutDigits),
          Shortened(test.largest_id, kLongestId)};
}

// Errors of whole validation curves, or of parameters from elsewhere on the fitted curves.
Section HeldOutSection(const FamilyReport& report) {
  Section section = {report.held_out ? "Curves that the fit did not see"
                                     : "Parameters from elsewhere on the curves fitted"};
  if (!report.held_out && !report.in_sample) return section;
  if (report.key_points && report.against.empty()) return section;
  const HeldOut& joint = report.held_out ? *report.held_out : *report.in_sample;
  const double isc = report.reference.short_circuit_current_A;
  block::Table table = {"llrrrrl",
                        {{"", "", "median", "of Isc", "all points", "worst", ""},
                         {"parameters", "law", "RMSE (A)", "%", "RMSE (A)", "RMSE (A)", "curve"}}};
  table.rows.push_back(HeldOutRow("joint fit", LawTitle(report.translation.spec.law), joint, isc));
  for (const Against& other : report.against) {
    table.rows.push_back(HeldOutRow(other.name, other.law, other.result, isc));
  }
  if (!std::isnan(joint.median_individual_rmse_A)) {
    table.rows.push_back({"each curve on its own", "",
                          Scientific(joint.median_individual_rmse_A, kHeldOutDigits),
                          PercentOfIsc(joint.median_individual_rmse_A, isc), "-", "-", ""});
  }
  std::string note =
      "RMSE: solved-current; median: of the curves; %: that median as a part of the Isc that the "
      "joint fit has at 1000 W/m2 and 25 C. A curve on its own is the floor: no law can do "
      "better.";
  if (!report.against.empty() && !(std::isnan(report.irradiance_offset_W_m2.value) &&
                                   std::isnan(report.temperature_offset_K.value))) {
    note += " Only the joint fit is given the sensors' errors that it found.";
  }
  AddField("tested on", joint.how, &section);
  AddTable(std::move(table), &section);
  AddSentence(note, &section);
  return section;
}

std::string BothLabelled(const RmsePair& rmse) {
  return fmt::format("{} A measured-current, {} A solved-current",
                     Scientific(rmse.measured_current_A, 4), Scientific(rmse.solved_current_A, 4));
}

// The first of many sentences, and the number of the others.
Section ShortList(const std::string& title, std::vector<std::string> sentences) {
  const std::size_t all = sentences.size();
  if (all > kMostNamed) {
    sentences.resize(kMostNamed);
    sentences.push_back(
        fmt::format("and {} more; all are in the JSON report (--json FILE)", all - kMostNamed));
  }
  return ListSection(title, std::move(sentences));
}

// Adds the shared parameters of a fit without the outlier curves.
void AddWithoutOutliers(const FamilyReport& report, const WithoutOutliers& without,
                        Section* section) {
  const char* const them = without.ids.size() == 1 ? "it" : "them";
  if (without.cells.empty()) {
    AddSentence(fmt::format("Without {}: RMSE {}.", them, BothLabelled(without.rmse)), section);
  }
  std::string values;
  for (std::size_t i = 0; i < without.shared.size() && i < report.estimates.size(); ++i) {
    const ParameterInfo& info = report.estimates[i].info;
    values +=
        fmt::format("{}{} {}{}", values.empty() ? "" : ", ", info.symbol,
                    Significant(without.shared[i], 5), info.unit.empty() ? "" : " " + info.unit);
  }
  if (values.empty()) return;
  AddSentence(fmt::format("Parameters without {}: {}", them, values), section);
}

Section OutlierSection(const FamilyReport& report) {
  std::vector<std::string> ids;
  std::vector<std::string> sentences;
  for (const FamilyCurve& curve : report.curves) {
    if (!curve.outlier) continue;
    ids.push_back(curve.id);
    if (report.key_points) continue;
    sentences.push_back(fmt::format(
        "curve {} looks like another device: solved-current RMSE {} A under the shared parameters, "
        "{} A on its own",
        curve.id, Scientific(curve.rmse.solved_current_A, 3),
        Scientific(curve.individual_rmse.solved_current_A, 3)));
  }
  if (report.key_points && report.without_outliers) {
    for (const OutlierCell& cell : report.without_outliers->cells) {
      sentences.push_back(fmt::format("{} of {}: measured {} {}, expected {} {}", cell.point,
                                      cell.id, Significant(cell.measured, 4), cell.unit,
                                      Significant(cell.expected, 4), cell.unit));
    }
  }
  Section section =
      ShortList(report.key_points ? "Wrong values" : "Odd curves", std::move(sentences));
  if (ids.empty()) return section;
  if (report.without_outliers) {
    AddWithoutOutliers(report, *report.without_outliers, &section);
    ids = report.without_outliers->ids;
  }
  AddSentence(fmt::format(report.key_points ? "To fit without the conditions: --leave-out '{}'"
                                            : "To fit without: --leave-out {}",
                          fmt::join(ids, ",")),
              &section);
  return section;
}

Section LeftOutSection(const FamilyReport& report) {
  std::vector<std::string> left_out;
  for (const FamilyCurve& curve : report.curves) {
    if (curve.role != CurveRole::kLeftOut) continue;
    left_out.push_back(curve.reason.empty() ? curve.id
                                            : fmt::format("{}: {}", curve.id, curve.reason));
  }
  return ShortList("Left out", std::move(left_out));
}

Section RejectedSection(const FamilyReport& report) {
  std::vector<std::string> rejected;
  for (const RejectedCurve& curve : report.rejected) {
    rejected.push_back(fmt::format("{}: {}", curve.id, curve.error.ToString()));
  }
  return ShortList("Rejected: could not be read", std::move(rejected));
}

}  // namespace

std::vector<Section> FamilyCurveSections(const FamilyReport& report) {
  // The answer of curves fitted one by one, and of a comparison that was asked for.
  const auto unless = [](bool answer, Section section) {
    return answer ? section : Further(std::move(section));
  };
  const bool alone = OneByOne(report);
  return {unless(alone, CurveSection(report)),
          unless(alone, OffsetSection(report)),
          unless(alone, IndividualFitSection(report)),
          unless(!report.against.empty(), HeldOutSection(report)),
          OutlierSection(report),
          LeftOutSection(report),
          RejectedSection(report)};
}

}  // namespace lyrefit
