#include "lyrefit/report/diagnosis_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "lyrefit/report/diagnosis_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

// "200 to 1000", "25"
std::string NoiseSpread(double low, double high) {
  return high > low ? fmt::format("{:.5g} to {:.5g}", low, high) : fmt::format("{:.5g}", low);
}

std::string ConditionsText(const Diagnosis& diagnosis) {
  if (diagnosis.curves.empty()) return "-";
  const auto by_irradiance = [](const DiagnosedCurve& a, const DiagnosedCurve& b) {
    return a.irradiance_W_m2 < b.irradiance_W_m2;
  };
  const auto by_temperature = [](const DiagnosedCurve& a, const DiagnosedCurve& b) {
    return a.temperature_C < b.temperature_C;
  };
  const auto& curves = diagnosis.curves;
  const auto [dim, bright] = std::minmax_element(curves.begin(), curves.end(), by_irradiance);
  const auto [cold, hot] = std::minmax_element(curves.begin(), curves.end(), by_temperature);
  const auto dark = static_cast<std::size_t>(std::count_if(
      curves.begin(), curves.end(), [](const DiagnosedCurve& curve) { return curve.dark; }));
  return fmt::format("{} W/m2, {} C{}", NoiseSpread(dim->irradiance_W_m2, bright->irradiance_W_m2),
                     NoiseSpread(cold->temperature_C, hot->temperature_C),
                     dark > 0 ? "; " + Plural(dark, "dark curve") : "");
}

// What a cause must be to be named.
std::string NamedText(const Diagnosis& diagnosis) {
  std::string text =
      fmt::format("certain at {:g} % over the whole catalogue", 100 * diagnosis.level);
  if (diagnosis.floor_current > 0) {
    text += fmt::format(", and above {:g} % of Isc (rms over the curve) or {:g} % of Pmax",
                        100 * diagnosis.floor_current, 100 * diagnosis.floor_power);
  }
  return text;
}

std::string Header(const Diagnosis& diagnosis) {
  std::string text = Banner(diagnosis.interrupted, diagnosis.extended.usable, {}, diagnosis.doubts);
  text += fmt::format("lyrefit {}: diagnosis of {}\n", diagnosis.version, diagnosis.name);
  text += Field(
      "measured",
      fmt::format("{}; {}, {}{}", diagnosis.evidence.kind, Plural(diagnosis.curves.size(), "curve"),
                  Plural(diagnosis.points.size(), "point"),
                  diagnosis.source.empty() ? "" : fmt::format(" ({})", diagnosis.source)));
  text += Field("conditions", ConditionsText(diagnosis));
  text += Field("base model", fmt::format("{}: {}", diagnosis.base, diagnosis.base_sentence));
  text += Field("objective", fmt::format("solved-current; seed {}", diagnosis.seed));
  text += Field("named", NamedText(diagnosis));
  return text;
}

std::string RunSection(const Diagnosis& diagnosis) {
  return "How it was found\n" + Field("time", Duration(diagnosis.seconds)) +
         Field("options", OptionsText(diagnosis.non_default_options));
}

// "irradiance_step d -0.0190 (corrected p 2.0e-07) or irradiance_drift"
std::string BriefCause(const Cause& cause) {
  std::string text = cause.id;
  if (!cause.strength.empty()) {
    const CauseParameter& first = cause.strength.front();
    text += fmt::format(" {} {}{}{}", first.symbol, Significant(first.value, 3),
                        first.unit.empty() ? "" : " ", first.unit);
  }
  text += fmt::format(" (corrected p {})", Significant(cause.corrected_p, 2));
  for (const std::string& id : cause.equivalents) text += " or " + id;
  return text;
}

}  // namespace

std::string DiagnosisText(const Diagnosis& diagnosis) {
  std::string text = Header(diagnosis);
  for (const std::string& section :
       {DiagnosisVerdictSection(diagnosis), DiagnosisCauseSections(diagnosis),
        DiagnosisPlanSection(diagnosis), DiagnosisBelowSection(diagnosis),
        DiagnosisGainSection(diagnosis), DiagnosisShiftSection(diagnosis),
        DiagnosisEvidenceSection(diagnosis), DiagnosisTrialSection(diagnosis),
        DiagnosisUntriedSection(diagnosis), DiagnosisLimitSection(diagnosis), RunSection(diagnosis),
        List("Assumed", diagnosis.assumptions), List("Warnings", diagnosis.warnings)}) {
    if (!section.empty()) text += "\n" + section;
  }
  return text;
}

std::string BriefDiagnosis(const Diagnosis& diagnosis) {
  const Gain& gain = diagnosis.gain;
  std::string text;
  for (const Cause& cause : diagnosis.verdict.causes) {
    text += (text.empty() ? "" : "; ") + BriefCause(cause);
  }
  if (text.empty()) text = FullSentence(diagnosis.verdict.sentence);
  text +=
      fmt::format("{} RMSE {}", text.back() == '.' ? "" : ";", Scientific(gain.rmse_before_A, 4));
  if (diagnosis.verdict.found) text += " -> " + Scientific(gain.rmse_after_A, 4);
  text += " A solved-current" +
          BriefMarks(diagnosis.interrupted, diagnosis.extended.usable, diagnosis.warnings.size());
  return diagnosis.name + ": " + text + "\n";
}

}  // namespace lyrefit
