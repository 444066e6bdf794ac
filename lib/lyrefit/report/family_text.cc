#include "lyrefit/report/family_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

std::size_t Count(const FamilyReport& report, CurveRole role) {
  return static_cast<std::size_t>(
      std::count_if(report.curves.begin(), report.curves.end(),
                    [role](const FamilyCurve& curve) { return curve.role == role; }));
}

// "50 fitted, 3 held out, 1 left out, 2 rejected"
std::string Counts(const FamilyReport& report) {
  return fmt::format("{} fitted, {} held out, {} left out, {} rejected",
                     Count(report, CurveRole::kFitted), Count(report, CurveRole::kHeldOut),
                     Count(report, CurveRole::kLeftOut), report.rejected.size());
}

// "irradiance 98 to 1006 W/m2, cell temperature 15 to 65 C"
std::string RangeText(const FamilyReport& report) {
  if (report.curves.empty()) return "";
  const auto by_irradiance = [](const FamilyCurve& a, const FamilyCurve& b) {
    return a.irradiance_W_m2 < b.irradiance_W_m2;
  };
  const auto by_temperature = [](const FamilyCurve& a, const FamilyCurve& b) {
    return a.temperature_C < b.temperature_C;
  };
  const auto [dim, bright] =
      std::minmax_element(report.curves.begin(), report.curves.end(), by_irradiance);
  const auto [cold, hot] =
      std::minmax_element(report.curves.begin(), report.curves.end(), by_temperature);
  return fmt::format("irradiance {:.5g} to {:.5g} W/m2, cell temperature {:.4g} to {:.4g} C",
                     dim->irradiance_W_m2, bright->irradiance_W_m2, cold->temperature_C,
                     hot->temperature_C);
}

std::string Law(const FamilyReport& report) {
  const TranslationSpec& spec = report.translation.spec;
  return fmt::format("{}, shunt {}{}", ToText(spec.law), ToText(spec.shunt),
                     spec.recombination ? ", recombination in the i-layer" : "");
}

std::string Header(const FamilyReport& report) {
  std::string text = Banner(report.interrupted, report.usable, {}, report.doubts);
  const TranslationSpec& spec = report.translation.spec;
  const std::string model = ModelTitle(spec.model);
  text += fmt::format("lyrefit {}: ", report.version);
  text += OneByOne(report)
              ? fmt::format("{} model of every curve of {} on its own\n", model, report.name)
              : fmt::format("one {} device by the law of {} behind the curves of {}\n", model,
                            LawTitle(spec.law), report.name);
  text += Field("set", fmt::format("{}, {}{}", report.name, Plural(report.curves.size(), "curve"),
                                   report.source.empty() ? "" : " (" + report.source + ")"));
  text += Field("curves", Counts(report));
  text += Field("conditions", fmt::format("{}; {} in series", RangeText(report),
                                          Plural(report.cells_in_series, "cell")));
  if (!OneByOne(report)) text += Field("law", Law(report));
  if (!report.with.empty()) text += Field("effects", EffectTitles(report.with));
  text += Field("objective", fmt::format("{}; constants {}; seed {}", ToText(report.objective),
                                         ToText(spec.constants), report.search_options.seed));
  return text;
}

}  // namespace

std::string FamilyText(const FamilyReport& report) {
  std::string text = Header(report);
  for (const std::string& section :
       {FamilyCandidateSection(report), FamilyParameterSection(report), FamilySensorSection(report),
        FamilyReferenceSection(report), FamilyRmseSection(report), FamilyCurveSection(report),
        FamilyOffsetSection(report), FreeFitSection(report), FamilyHeldOutSection(report),
        FamilyOddSection(report), FamilyOutSection(report), FamilySearchSection(report),
        List("Assumptions", report.assumptions), List("Warnings", report.warnings)}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::string BriefFamily(const FamilyReport& report) {
  const TranslationSpec& spec = report.translation.spec;
  const RmsePair& rmse = report.rmse.refined;
  std::string text =
      fmt::format("{}: {} {}, {}, RMSE {} A measured-current, {} A solved-current (fitted: {})",
                  report.name, OneByOne(report) ? "free" : ToText(spec.law), ToText(spec.model),
                  Counts(report), Scientific(rmse.measured_current_A, 6),
                  Scientific(rmse.solved_current_A, 6), ToText(report.objective));
  for (const Estimate& e : report.estimates) {
    text += fmt::format(", {} {}{}{}", e.info.symbol, Significant(e.refined, 6),
                        e.info.unit.empty() ? "" : " ", e.info.unit);
  }
  text += BriefMarks(report.interrupted, report.usable, report.warnings.size());
  return text + "\n";
}

}  // namespace lyrefit
