#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kHeldOutDigits = 4;
constexpr std::size_t kLongestFile = 24;  // of a file
constexpr std::size_t kLongestHeldOutId = 16;

std::string Shortened(const std::string& name, std::size_t longest) {
  return name.size() <= longest ? name : name.substr(0, longest - 2) + "..";
}

std::string PercentOfIsc(double rmse_A, double isc_A) {
  const double percent = 100 * rmse_A / isc_A;
  return std::isfinite(percent) ? fmt::format("{:.3f}", percent) : "-";
}

void AddRow(const std::string& name, const std::string& law, const HeldOut& test, double isc_A,
            TextTable* table) {
  table->Add({Shortened(name, kLongestFile), law, Scientific(test.median_rmse_A, kHeldOutDigits),
              PercentOfIsc(test.median_rmse_A, isc_A),
              Scientific(test.rmse.solved_current_A, kHeldOutDigits),
              Scientific(test.largest_rmse_A, kHeldOutDigits),
              Shortened(test.largest_id, kLongestHeldOutId)});
}

}  // namespace

std::string FamilyHeldOutSection(const FamilyReport& report) {
  if (!report.held_out && !report.in_sample) return "";
  const HeldOut& joint = report.held_out ? *report.held_out : *report.in_sample;
  const double isc = report.reference.short_circuit_current_A;
  TextTable table("llrrrrl");
  table.Add({"", "", "median", "of Isc", "all points", "worst", ""});
  table.Add({"parameters", "law", "RMSE (A)", "%", "RMSE (A)", "RMSE (A)", "curve"});
  AddRow("joint fit", LawTitle(report.translation.spec.law), joint, isc, &table);
  for (const Against& other : report.against) {
    AddRow(other.name, other.law, other.result, isc, &table);
  }
  if (!std::isnan(joint.median_free_rmse_A)) {
    table.Add({"each curve on its own", "", Scientific(joint.median_free_rmse_A, kHeldOutDigits),
               PercentOfIsc(joint.median_free_rmse_A, isc), "-", "-", ""});
  }
  std::string note =
      "RMSE: solved-current; median: of the curves; %: that median as a part of the Isc that the "
      "joint fit has at 1000 W/m2 and 25 C. A curve on its own is the floor: no law can do "
      "better.";
  if (!report.against.empty() && !(std::isnan(report.irradiance_offset_W_m2.value) &&
                                   std::isnan(report.temperature_offset_K.value))) {
    note += " Only the joint fit is given the sensors' errors that it found.";
  }
  return std::string(report.held_out ? "Curves that the fit did not see\n"
                                     : "Parameters from elsewhere on the curves fitted\n") +
         Field("tested on", joint.how) + table.Text() + Wrap("  ", note);
}

}  // namespace lyrefit
