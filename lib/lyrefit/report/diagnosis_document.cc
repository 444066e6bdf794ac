#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/report/documents.h"
#include "lyrefit/report/record_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kSizeDigits = 3;
constexpr int kCauseDigits = 5;
constexpr double kLargestShiftPercent = 1000;  // above it a relative difference is meaningless

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

// Conditions for a cause to be named.
std::string NamedText(const Diagnosis& diagnosis) {
  std::string text = fmt::format("more probable than {:g} %", 100 * diagnosis.probability);
  if (diagnosis.floor_current > 0) {
    text += fmt::format(", and above {:g} % of Isc (rms over the curve) or {:g} % of Pmax",
                        100 * diagnosis.floor_current, 100 * diagnosis.floor_power);
  }
  return text;
}

Section DiagnosisHead(const Diagnosis& diagnosis) {
  Section head = {fmt::format("lyrefit {}: diagnosis of {}", diagnosis.version, diagnosis.name)};
  AddField(
      "measured",
      fmt::format("{}; {}, {}{}", diagnosis.evidence.kind, Plural(diagnosis.curves.size(), "curve"),
                  Plural(diagnosis.points.size(), "point"),
                  diagnosis.source.empty() ? "" : fmt::format(" ({})", diagnosis.source)),
      &head);
  AddField("conditions", ConditionsText(diagnosis), &head);
  AddField("base model", fmt::format("{}: {}", diagnosis.base, diagnosis.base_sentence), &head);
  AddField("objective", fmt::format("solved-current; seed {}", diagnosis.seed), &head);
  AddField("named", NamedText(diagnosis), &head);
  return head;
}

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

// "97 %"
std::string WholePercent(double part) {
  return std::isfinite(part) ? fmt::format("{:.0f} %", 100 * part) : "-";
}

std::string CertaintyText(const Cause& cause) {
  if (cause.evidence == "values") return "seen in the values themselves";
  return "probability " + WholePercent(cause.probability);
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

// Title and id of an effect: "step of the irradiance (irr_step)".
std::string EffectLabel(const Diagnosis& diagnosis, const std::string& id) {
  for (const Trial& trial : diagnosis.trials) {
    if (trial.effect == id) return fmt::format("{} ({})", trial.title, id);
  }
  return id;
}

Section CauseSection(const Diagnosis& diagnosis, const Cause& cause, const std::string& before) {
  Section section = {fmt::format("{}: {} ({})", before, cause.title, cause.id)};
  for (const std::string& words : cause.in_words) AddSentence(FullSentence(words), &section);
  AddSentence(FullSentence(cause.sentence), &section);
  const std::string effect = EffectText(cause);
  if (!effect.empty()) AddField("effect", effect, &section);
  for (std::size_t i = 0; i < cause.strength.size(); ++i) {
    AddField(i == 0 ? "size" : "", SizeText(cause.strength[i]), &section);
  }
  AddField("certainty", CertaintyText(cause), &section);
  if (!cause.acts.empty()) AddField("acts", cause.acts, &section);
  std::vector<std::string> others;
  for (const std::string& id : cause.equivalents) others.push_back(EffectLabel(diagnosis, id));
  if (!others.empty()) {
    AddField("or else",
             fmt::format("{}: these data cannot tell them apart", fmt::join(others, "; ")),
             &section);
  }
  if (!cause.separate_by.empty()) {
    AddField("to tell", fmt::format("{}", fmt::join(cause.separate_by, "; ")), &section);
  }
  return section;
}

}  // namespace

std::vector<Section> CauseSections(const Diagnosis& diagnosis) {
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  std::vector<Section> sections;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    sections.push_back(
        CauseSection(diagnosis, causes[i], fmt::format("Cause {} of {}", i + 1, causes.size())));
  }
  return sections;
}

namespace {

std::vector<Section> BelowSections(const Diagnosis& diagnosis) {
  std::vector<Section> sections;
  for (const Cause& cause : diagnosis.verdict.below_floor) {
    sections.push_back(CauseSection(diagnosis, cause, "Present, not material"));
  }
  return sections;
}

// The next measurements that would separate the causes.
Section PlanSection(const Diagnosis& diagnosis) {
  Section section = {"What would tell them apart"};
  if (!diagnosis.plan) return section;
  const Plan& plan = *diagnosis.plan;
  AddSentence(FullSentence(plan.sentence), &section);
  if (plan.measurements.empty()) return section;
  AddField("between", fmt::format("{}", fmt::join(plan.causes, ", ")), &section);
  block::Table table = {"lr" + std::string(plan.causes.size(), 'r'),
                        {{"right name, besides these data", "mean"}}};
  for (const std::string& id : plan.causes) table.heads[0].push_back("if " + id);
  std::vector<std::string> how;
  for (const PlannedMeasurement& measurement : plan.measurements) {
    std::vector<std::string> row = {measurement.id, WholePercent(measurement.probability)};
    for (const PlannedCause& cause : measurement.causes) {
      row.push_back(WholePercent(cause.probability));
    }
    table.rows.push_back(std::move(row));
    how.push_back(fmt::format("{}: {}; {}.", measurement.id, measurement.title, measurement.taken));
  }
  AddTable(std::move(table), &section);
  AddList(std::move(how), &section);
  AddSentence(
      "Simulated: each cause in turn is the true one, the readings it would give are drawn, and "
      "all causes are fitted to old and new readings.",
      &section);
  return section;
}

// Gain of a diagnosis without a cause.
Section BaseGainSection(const Gain& gain) {
  std::string text = Scientific(gain.rmse_before_A, 4) + " A, solved-current";
  if (std::isfinite(gain.held_out_before_A)) {
    text += fmt::format("; held out in {} {} A", Plural(gain.folds, "part"),
                        Scientific(gain.held_out_before_A, 4));
  }
  Section section = {"Gain"};
  AddField("base RMSE", text, &section);
  AddSentence(FullSentence(gain.sentence), &section);
  return section;
}

Section GainSection(const Gain& gain) {
  block::Table table = {"lrr", {{"RMSE in A, solved-current", "base model", "with causes"}}};
  table.rows.push_back({"readings that were fitted", Scientific(gain.rmse_before_A, 4),
                        Scientific(gain.rmse_after_A, 4)});
  if (std::isfinite(gain.held_out_before_A)) {
    table.rows.push_back({fmt::format("held out{} in {}", gain.by_sweeps ? ", whole sweeps," : "",
                                      Plural(gain.folds, "part")),
                          Scientific(gain.held_out_before_A, 4),
                          Scientific(gain.held_out_after_A, 4)});
  }
  Section section = {"Gain"};
  AddTable(std::move(table), &section);
  if (std::isfinite(gain.held_out_gain_A2)) {
    AddSentence(
        fmt::format("Held-out mean square without minus with causes: {} A2, standard error {} A2.",
                    Significant(gain.held_out_gain_A2, 3),
                    Significant(gain.held_out_gain_error_A2, 2)),
        &section);
  }
  AddSentence(FullSentence(gain.sentence), &section);
  return section;
}

// Relative difference of the base model's value from the extended model's.
std::string OffBy(const ParameterShift& shift) {
  const double percent = 100 * (shift.before / shift.after - 1);
  return std::abs(percent) < kLargestShiftPercent ? fmt::format("{:+.2f} %", percent) : "-";
}

std::string ShiftLabel(const ParameterShift& shift) {
  return LabelWithUnit({shift.symbol, shift.name, shift.unit, ""});
}

// Parameters of a diagnosis without causes to correct for.
Section BaseSection(const std::vector<ParameterShift>& shifts) {
  Section section = {"Parameters of the base model"};
  if (shifts.empty()) return section;
  block::Table table = {"lrr", {{"", "base model", "std err"}}};
  for (const ParameterShift& shift : shifts) {
    table.rows.push_back({ShiftLabel(shift), Significant(shift.before, kCauseDigits),
                          Significant(shift.standard_error, 2)});
  }
  AddTable(std::move(table), &section);
  return section;
}

Section ShiftSection(const std::vector<ParameterShift>& shifts) {
  Section section = {"What a fit that ignores the causes gets wrong"};
  if (shifts.empty()) return section;
  block::Table table = {"lrrrr",
                        {{"", "base model", "with causes", "std err", "base model is off by"}}};
  for (const ParameterShift& shift : shifts) {
    table.rows.push_back({ShiftLabel(shift), Significant(shift.before, kCauseDigits),
                          Significant(shift.after, kCauseDigits),
                          Significant(shift.standard_error, 2), OffBy(shift)});
  }
  AddTable(std::move(table), &section);
  return section;
}

Section RunSection(const Diagnosis& diagnosis) {
  Section section = {"How it was found"};
  AddField("time", Duration(diagnosis.seconds), &section);
  AddField("options", OptionsText(diagnosis.non_default_options), &section);
  return section;
}

// "irr_step d -0.0190 (98 %) or drift"
std::string BriefCause(const Cause& cause) {
  std::string text = cause.id;
  if (!cause.strength.empty()) {
    const CauseParameter& first = cause.strength.front();
    text += fmt::format(" {} {}{}{}", first.symbol, Significant(first.value, 3),
                        first.unit.empty() ? "" : " ", first.unit);
  }
  text += fmt::format(" ({})", WholePercent(cause.probability));
  for (const std::string& id : cause.equivalents) text += " or " + id;
  return text;
}

}  // namespace

Document DiagnosisDocument(const Diagnosis& diagnosis) {
  const Gain& gain = diagnosis.gain;
  const bool found = diagnosis.verdict.found;
  Document document = {
      Banners(diagnosis.interrupted, diagnosis.extended.usable, {}, diagnosis.doubts),
      DiagnosisHead(diagnosis)};
  AddSections({{"Verdict", {block::Sentence{FullSentence(diagnosis.verdict.sentence)}}}},
              &document);
  AddSections(CauseSections(diagnosis), &document);
  AddSections({PlanSection(diagnosis)}, &document);
  AddSections(BelowSections(diagnosis), &document);
  AddSections({found ? GainSection(gain) : BaseGainSection(gain),
               found ? ShiftSection(gain.shifts) : BaseSection(gain.shifts)},
              &document);
  AddSections(DiagnosisEvidenceSections(diagnosis), &document);
  AddSections({RunSection(diagnosis), ListSection("Assumed", diagnosis.assumptions),
               WarningSection(diagnosis.warnings)},
              &document);
  document.verdict = FullSentence(diagnosis.verdict.sentence);
  AddFigure(FigureBlock(diagnosis), &document.head);
  return document;
}

std::string DiagnosisText(const Diagnosis& diagnosis) {
  return DrawText(DiagnosisDocument(diagnosis));
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
