#include <fmt/format.h>

#include <cmath>

#include "lyrefit/report/diagnosis_sections.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kSizeDigits = 3;
constexpr int kCauseDigits = 5;
constexpr double kLargestShiftPercent = 1000;  // beyond it a relative difference says nothing

std::string WithUnit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

// "relative step d = -0.0190, 95 %: -0.0212 .. -0.0168"
std::string SizeText(const CauseParameter& parameter) {
  std::string name = parameter.name;
  for (char& c : name) c = c == '_' ? ' ' : c;
  std::string text =
      fmt::format("{} {} = {}", name, parameter.symbol,
                  WithUnit(Significant(parameter.value, kSizeDigits), parameter.unit));
  if (std::isfinite(parameter.low_95) || std::isfinite(parameter.high_95)) {
    text += fmt::format(", 95 %: {}",
                        WithUnit(Range(parameter.low_95, parameter.high_95), parameter.unit));
  }
  return text + (parameter.at_bound ? ", at its bound" : "");
}

std::string CertaintyText(const Cause& cause, double level) {
  std::string p =
      fmt::format("corrected p = {}, to be below {:g}", Significant(cause.corrected_p, 2), level);
  if (cause.evidence != "values") return p;
  return "seen in the values themselves" + (std::isnan(cause.corrected_p) ? "" : "; " + p);
}

// "0.86 % (0.80 .. 0.92)"
std::string PercentText(const Sized& size) {
  std::string text = Significant(100 * size.value, 3) + " %";
  if (std::isfinite(size.low_95)) {
    text += fmt::format(" ({})", Range(100 * size.low_95, 100 * size.high_95));
  }
  return text;
}

std::string EffectText(const Cause& cause) {
  std::string text;
  if (std::isfinite(cause.current_effect.value)) {
    text = PercentText(cause.current_effect) + " of Isc, root mean square over the curve";
  }
  if (std::isfinite(cause.power_effect.value)) {
    text += fmt::format("{}{} of Pmax", text.empty() ? "" : "; ", PercentText(cause.power_effect));
  }
  return text;
}

std::string CauseText(const Diagnosis& diagnosis, const Cause& cause) {
  std::string text;
  for (const std::string& words : cause.in_words) text += Wrap("  ", FullSentence(words));
  text += Wrap("  ", FullSentence(cause.sentence));
  const std::string effect = EffectText(cause);
  if (!effect.empty()) text += Field("effect", effect);
  for (std::size_t i = 0; i < cause.strength.size(); ++i) {
    text += Field(i == 0 ? "size" : "", SizeText(cause.strength[i]));
  }
  text += Field("certainty", CertaintyText(cause, diagnosis.level));
  if (!cause.acts.empty()) text += Field("acts", cause.acts);
  std::vector<std::string> others;
  for (const std::string& id : cause.equivalents) others.push_back(EffectLabel(diagnosis, id));
  if (!others.empty())
    text += Field("or else", fmt::format("{}", fmt::join(others, "; ")) +
                                 ": these data cannot tell them apart");
  if (!cause.separate_by.empty())
    text += Field("to tell", fmt::format("{}", fmt::join(cause.separate_by, "; ")));
  return text;
}

// How far the base model's value is from that of the extended one.
std::string OffBy(const ParameterShift& shift) {
  const double percent = 100 * (shift.before / shift.after - 1);
  return std::abs(percent) < kLargestShiftPercent ? fmt::format("{:+.2f} %", percent) : "-";
}

// Where there is nothing to allow for.
std::string BaseParameters(const std::vector<ParameterShift>& shifts) {
  TextTable table("lrr");
  table.Add({"", "base model", "std err"});
  for (const ParameterShift& shift : shifts) {
    table.Add({LabelWithUnit({shift.symbol, shift.name, shift.unit, ""}),
               Significant(shift.before, kCauseDigits), Significant(shift.standard_error, 2)});
  }
  return "Parameters of the base model\n" + table.Text();
}

}  // namespace

std::string EffectLabel(const Diagnosis& diagnosis, const std::string& id) {
  for (const Trial& trial : diagnosis.trials) {
    if (trial.effect == id) return fmt::format("{} ({})", trial.title, id);
  }
  return id;
}

std::string FullSentence(std::string text) {
  if (!text.empty() && text.back() != '.') text += '.';
  return text;
}

std::string DiagnosisVerdictSection(const Diagnosis& diagnosis) {
  return "Verdict\n" + Wrap("  ", FullSentence(diagnosis.verdict.sentence));
}

std::string DiagnosisCauseSections(const Diagnosis& diagnosis) {
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  std::string text;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    text += fmt::format("{}Cause {} of {}: {} ({})\n", i == 0 ? "" : "\n", i + 1, causes.size(),
                        causes[i].title, causes[i].id) +
            CauseText(diagnosis, causes[i]);
  }
  return text;
}

std::string DiagnosisBelowSection(const Diagnosis& diagnosis) {
  std::string text;
  for (const Cause& cause : diagnosis.verdict.below_floor) {
    text += fmt::format("Present, not material: {} ({})\n", cause.title, cause.id) +
            CauseText(diagnosis, cause);
  }
  return text;
}

std::string DiagnosisGainSection(const Diagnosis& diagnosis) {
  const Gain& gain = diagnosis.gain;
  if (!diagnosis.verdict.found) {
    std::string text = Scientific(gain.rmse_before_A, 4) + " A, solved-current";
    if (std::isfinite(gain.held_out_before_A)) {
      text += fmt::format("; held out in {} {} A", Plural(gain.folds, "part"),
                          Scientific(gain.held_out_before_A, 4));
    }
    return "Gain\n" + Field("base RMSE", text) + Wrap("  ", FullSentence(gain.sentence));
  }
  TextTable table("lrr");
  table.Add({"RMSE in A, solved-current", "base model", "with causes"});
  table.Add({"readings that were fitted", Scientific(gain.rmse_before_A, 4),
             Scientific(gain.rmse_after_A, 4)});
  if (std::isfinite(gain.held_out_before_A)) {
    table.Add({fmt::format("held out{} in {}", gain.by_sweeps ? ", whole sweeps," : "",
                           Plural(gain.folds, "part")),
               Scientific(gain.held_out_before_A, 4), Scientific(gain.held_out_after_A, 4)});
  }
  std::string text = "Gain\n" + table.Text();
  if (std::isfinite(gain.held_out_gain_A2)) {
    text += Wrap(
        "  ",
        fmt::format("Held-out mean square without minus with causes: {} A2, standard error {} A2.",
                    Significant(gain.held_out_gain_A2, 3),
                    Significant(gain.held_out_gain_error_A2, 2)));
  }
  return text + Wrap("  ", FullSentence(gain.sentence));
}

std::string DiagnosisShiftSection(const Diagnosis& diagnosis) {
  if (diagnosis.gain.shifts.empty()) return "";
  if (!diagnosis.verdict.found) return BaseParameters(diagnosis.gain.shifts);
  TextTable table("lrrrr");
  table.Add({"", "base model", "with causes", "std err", "base model is off by"});
  for (const ParameterShift& shift : diagnosis.gain.shifts) {
    table.Add({LabelWithUnit({shift.symbol, shift.name, shift.unit, ""}),
               Significant(shift.before, kCauseDigits), Significant(shift.after, kCauseDigits),
               Significant(shift.standard_error, 2), OffBy(shift)});
  }
  return "What a fit that ignores the causes gets wrong\n" + table.Text();
}

}  // namespace lyrefit
