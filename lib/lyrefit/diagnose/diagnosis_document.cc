#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/diagnose/diagnosis_parts.h"
#include "lyrefit/report/text_layout.h"
#include "lyrefit/report/text_parts.h"

namespace lyrefit {
namespace {

constexpr int kSizeDigits = 3;
constexpr int kCauseDigits = 5;
constexpr double kLargestShiftPercent = 1000;  // above it a relative difference is meaningless

// "200 to 1000", "25"
std::string NoiseSpread(double low, double high) {
  return high > low ? fmt::format("{:.4g} to {:.4g}", low, high) : fmt::format("{:.4g}", low);
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

void AddIfAny(const char* name, const std::string& text, Section* section) {
  if (!text.empty()) AddField(name, text, section);
}

// "flash, as the file says (line 3): ..."; empty where nobody says where it was measured.
std::string SetupText(const JudgedSetup& judged) {
  const char* what = "sky, shade and wind may disturb it";
  if (judged.setup == Setup::kUnknown) return "";
  if (judged.setup == Setup::kFlash) {
    what = "no shade and no sky; unlike currents are of the cells, or of a lamp that is uneven";
  } else if (judged.setup == Setup::kInverter) {
    what = "few readings in whole steps, often without short circuit";
  } else if (judged.setup == Setup::kLaboratory) {
    what = "no sky and no wind; lamps falter less";
  }
  return fmt::format("{}, {} ({}): {}", ToText(judged.setup),
                     judged.from == "stated" ? "stated" : "as the file says", judged.source, what);
}

Section DiagnosisHead(const Diagnosis& diagnosis) {
  Section head = {fmt::format("lyrefit {}: diagnosis of {}", diagnosis.version, diagnosis.name)};
  const std::size_t curves = diagnosis.curves.size();
  const bool counted = diagnosis.evidence.kind.find("curve") != std::string::npos;
  AddField("measured",
           fmt::format("{}; {}{}; {}", diagnosis.evidence.kind,
                       curves > 1 && !counted ? Plural(curves, "curve") + ", " : "",
                       Plural(diagnosis.points.size(), "point"), ConditionsText(diagnosis)),
           &head);
  AddIfAny("setup", SetupText(diagnosis.setup), &head);
  AddIfAny("assumed", fmt::format("{}", fmt::join(diagnosis.assumptions, "; ")), &head);
  return head;
}

std::string WithUnit(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

// "relative step d = -0.0190, 95 %: -0.0212 .. -0.0168"
std::string ParameterText(const CauseParameter& parameter) {
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
  if (std::isnan(cause.probability)) return "";
  return "probability " + WholePercent(cause.probability);
}

// "12 %", "1.4 %"
std::string ShortPercent(double part) {
  return fmt::format("{:.{}f} %", 100 * part, std::fabs(part) < 0.0995 ? 1 : 0);
}

// "0.86 % (0.80 to 0.92)", with two digits of half the interval at most.
std::string WithInterval(const Sized& size, double factor, const char* unit) {
  if (!std::isfinite(size.low_95)) {
    return fmt::format("{} {}", Significant(factor * size.value, 3), unit);
  }
  const double half = 0.5 * factor * (size.high_95 - size.low_95);
  const double digits = half > 0 ? std::ceil(-std::log10(half)) : 1;
  const int places = static_cast<int>(std::clamp(digits, 0.0, 4.0));
  return fmt::format("{:.{}f} {} ({:.{}f} to {:.{}f})", factor * size.value, places, unit,
                     factor * size.low_95, places, factor * size.high_95, places);
}

// "0.86 % (0.80 to 0.92)"
std::string PercentText(const Sized& size) { return WithInterval(size, 100, "%"); }

// Title and id of an effect: "step of the irradiance (irr_step)".
std::string EffectLabel(const Diagnosis& diagnosis, const std::string& id) {
  for (const Trial& trial : diagnosis.trials) {
    if (trial.effect == id) return fmt::format("{} ({})", trial.title, id);
  }
  return id;
}

// "12 to 18.4 V: from the moment of the step on"
std::string WhereText(const Diagnosis& diagnosis, const Cause& cause) {
  double low = kUnknown, high = kUnknown;
  for (const int k : cause.points) {
    const double voltage = diagnosis.points[k].voltage_V;
    low = low <= voltage ? low : voltage;
    high = high >= voltage ? high : voltage;
  }
  if (!std::isfinite(low)) return cause.acts;
  const int places = high >= 10 ? 1 : high >= 1 ? 2 : 3;
  const std::string from = fmt::format("{:.{}f}", low, places);
  const std::string to = fmt::format("{:.{}f}", high, places);
  return fmt::format("{}{} V{}{}", from == to ? "" : from + " to ", to,
                     cause.acts.empty() ? "" : ": ", cause.acts);
}

// `alone`: the misfit without it is that of the whole diagnosis, and is said there.
std::string SizeText(const Cause& cause, bool alone) {
  std::vector<std::string> words = cause.in_words;
  if (words.empty()) words = {cause.sentence};
  if (!alone && std::isfinite(cause.current_effect.value)) {
    words.push_back("without it the model misses by " +
                    WithInterval(cause.current_effect, 100, "% of Isc"));
  }
  return fmt::format("{}", fmt::join(words, "; "));
}

// Maximum power of the device; NaN if it is not known.
double MaxPower(const Diagnosis& diagnosis) {
  for (const ParameterShift& shift : diagnosis.gain.shifts) {
    if (shift.name == "max_power") return shift.after;
  }
  return kUnknown;
}

// "16.7 W (15.1 to 18.3), 7 % of Pmax", "180 W, 1.5 times what it gives now"; empty without power to gain.
std::string PowerText(const Diagnosis& diagnosis, const Sized& power, bool at_least) {
  if (at_least) return "a part of the loss at least: what all cells lose alike does not show";
  if (!std::isfinite(power.value)) return "";
  // Cells of a laboratory give milliwatts and less.
  const double size = std::max(std::fabs(power.value), power.high_95);
  std::string text = size < 1e-3 ? WithInterval(power, 1e6, "uW")
                     : size < 1  ? WithInterval(power, 1e3, "mW")
                                 : WithInterval(power, 1, "W");
  const double all = MaxPower(diagnosis);
  if (!(all > 0)) return text;
  const double part = power.value / all;
  return text + (part < 1 ? ", " + ShortPercent(part) + " of Pmax"
                          : fmt::format(", {:.1f} times what it gives now", part));
}

// What else could stand in the place of a cause: with probabilities if they are known.
std::string AlternativesText(const Diagnosis& diagnosis, const Cause& cause) {
  std::vector<std::string> others;
  for (const Alternative& other : cause.alternatives) {
    others.push_back(other.title + " " + ShortPercent(other.probability));
  }
  if (!others.empty()) return fmt::format("{}", fmt::join(others, ", "));
  for (const std::string& id : cause.equivalents) {
    if (id != cause.effect) others.push_back(EffectLabel(diagnosis, id));
  }
  if (others.empty()) return "";
  return fmt::format("{}: these data cannot tell them apart", fmt::join(others, "; "));
}

// Title of a cause, with its probability if it is known; with that of its first mechanism too, if
// others of its finding are not much less probable.
std::string CauseHeading(const Cause& cause, const std::string& before) {
  constexpr double kMost = 0.8;
  std::string text = fmt::format("{}: {} ({}", before, cause.title, cause.id);
  if (std::isfinite(cause.probability)) {
    text += ", " + ShortPercent(cause.probability);
    const auto& all = cause.mechanisms;
    if (all.size() > 1 && all.front().probability < kMost * cause.probability) {
      text += "; this mechanism " + ShortPercent(all.front().probability);
    }
  }
  return text + ")";
}

// What a technician needs of a cause.
Section CauseSection(const Diagnosis& diagnosis, const Cause& cause, const std::string& before) {
  Section section = {CauseHeading(cause, before)};
  AddIfAny("where", WhereText(diagnosis, cause), &section);
  const bool alone = diagnosis.verdict.causes.size() == 1 && !diagnosis.verdict.comparison.empty();
  AddField("size", SizeText(cause, alone), &section);
  AddIfAny("to gain", PowerText(diagnosis, cause.recoverable_power_W, cause.at_least), &section);
  const std::string sheet = cause.fact_sheet.empty() ? "" : fmt::format(" ({})", cause.fact_sheet);
  if (!cause.action.empty()) AddField("to do", cause.action + sheet, &section);
  AddIfAny("or else", AlternativesText(diagnosis, cause), &section);
  if (!cause.separate_by.empty()) AddField("to tell", cause.separate_by.front(), &section);
  return section;
}

// Parameters and certainty of a cause.
Section CauseDetails(const Cause& cause) {
  Section section = {fmt::format("Parameters of {} ({})", cause.title, cause.id)};
  AddSentence(FullSentence(cause.sentence), &section);
  for (std::size_t i = 0; i < cause.strength.size(); ++i) {
    AddField(i == 0 ? "parameters" : "", ParameterText(cause.strength[i]), &section);
  }
  std::vector<std::string> without;
  if (std::isfinite(cause.current_effect.value)) {
    without.push_back(
        fmt::format("misfit {}", WithInterval(cause.current_effect, 100, "% of Isc")));
  }
  if (std::isfinite(cause.power_effect.value)) {
    without.push_back(
        fmt::format("error of Pmax of the base model {}", PercentText(cause.power_effect)));
  }
  AddIfAny("without it", fmt::format("{}", fmt::join(without, "; ")), &section);
  AddIfAny("certainty", CertaintyText(cause), &section);
  AddIfAny("to tell", fmt::format("{}", fmt::join(cause.separate_by, "; ")), &section);
  return Folded(section);
}

}  // namespace

std::vector<Section> CauseSections(const Diagnosis& diagnosis) {
  const std::vector<Cause>& causes = diagnosis.verdict.causes;
  std::vector<Section> sections;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const std::string group = causes[i].group.empty() ? "" : fmt::format(" ({})", causes[i].group);
    sections.push_back(CauseSection(diagnosis, causes[i],
                                    fmt::format("Cause {} of {}{}", i + 1, causes.size(), group)));
  }
  return sections;
}

namespace {

std::vector<Section> BelowSections(const Diagnosis& diagnosis) {
  std::vector<Section> sections;
  for (const Cause& cause : diagnosis.verdict.below_floor) {
    sections.push_back(Folded(CauseSection(diagnosis, cause, "Present, not material")));
    sections.push_back(CauseDetails(cause));
  }
  return sections;
}

std::vector<Section> DetailSections(const Diagnosis& diagnosis) {
  std::vector<Section> sections;
  for (const Cause& cause : diagnosis.verdict.causes) {
    sections.push_back(CauseDetails(cause));
  }
  return sections;
}

// The whole: power of all causes together, comparison with modules without a fault, parameters out
// of range, limits of these readings.
Section WholeSection(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  Section section = {"The device"};
  const bool at_least = std::any_of(verdict.causes.begin(), verdict.causes.end(),
                                    [](const Cause& cause) { return cause.at_least; });
  const auto with_power =
      std::count_if(verdict.causes.begin(), verdict.causes.end(), [](const Cause& cause) {
        return std::isfinite(cause.recoverable_power_W.value) || cause.at_least;
      });
  if (with_power > 1) {
    AddIfAny("all to gain", PowerText(diagnosis, verdict.recoverable_power_W, at_least), &section);
  }
  AddIfAny("misfit", verdict.comparison, &section);
  for (const DeviceFinding& finding : diagnosis.device_findings) {
    const bool first = &finding == &diagnosis.device_findings.front();
    AddField(!first               ? ""
             : finding.if_silicon ? "if silicon"
                                  : "out of range",
             "it " + finding.sentence, &section);
    AddIfAny("to do", CauseOf(finding).action, &section);
  }
  if (verdict.found) AddIfAny("not shown", verdict.not_shown, &section);
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
        fmt::format(
            "Mean square of the held-out readings, without the causes minus with them: {} A2, "
            "standard error {} A2.",
            Significant(gain.held_out_gain_A2, 3), Significant(gain.held_out_gain_error_A2, 2)),
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
  AddIfAny("file", diagnosis.source, &section);
  AddField("base model", fmt::format("{}: {}", diagnosis.base, diagnosis.base_sentence), &section);
  AddField("objective", fmt::format("solved-current; seed {}", diagnosis.seed), &section);
  AddField("named", NamedText(diagnosis), &section);
  if (diagnosis.setup.setup == Setup::kUnknown) {
    AddField("setup", "unknown: causes as common as outdoors (--setup)", &section);
  }
  AddField("time", Duration(diagnosis.seconds), &section);
  AddField("options", OptionsText(diagnosis.non_default_options), &section);
  return section;
}

// Warnings that no banner says.
std::vector<std::string> OtherWarnings(const Diagnosis& diagnosis) {
  std::vector<std::string> others;
  for (const std::string& warning : diagnosis.warnings) {
    const auto& doubts = diagnosis.doubts;
    if (std::find(doubts.begin(), doubts.end(), warning) == doubts.end()) others.push_back(warning);
  }
  return others;
}

// "shading (86 %), 1 of 3 substrings under 71 % (69 to 73) of the others' light, 17 W (15 to 18), 7 %
// of Pmax to gain (or weak_cell)"
std::string BriefCause(const Diagnosis& diagnosis, const Cause& cause) {
  std::string text = cause.id;
  if (std::isfinite(cause.probability)) {
    text += " (" + ShortPercent(cause.probability) + ")";
  }
  if (!cause.in_words.empty()) text += ", " + cause.in_words.front();
  if (std::isfinite(cause.recoverable_power_W.value)) {
    text += ", " + PowerText(diagnosis, cause.recoverable_power_W, false) + " to gain";
  }
  std::vector<std::string> others = cause.equivalents;
  if (!cause.alternatives.empty()) others.clear();
  for (const Alternative& other : cause.alternatives) others.push_back(other.id);
  if (!others.empty()) text += fmt::format(" (or {})", fmt::join(others, ", "));
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
  AddSections({WholeSection(diagnosis), WarningSection(OtherWarnings(diagnosis))}, &document);
  AddSections(DetailSections(diagnosis), &document);
  AddSections(BelowSections(diagnosis), &document);
  AddSections({Folded(found ? GainSection(gain) : BaseGainSection(gain)),
               Folded(found ? ShiftSection(gain.shifts) : BaseSection(gain.shifts))},
              &document);
  for (Section& section : DiagnosisEvidenceSections(diagnosis)) {
    AddSections({Folded(std::move(section))}, &document);
  }
  AddSections({Folded(RunSection(diagnosis))}, &document);
  document.verdict = FullSentence(diagnosis.verdict.sentence);
  AddFigure(FigureBlock(diagnosis), &document.head);
  return document;
}

std::string DiagnosisText(const Diagnosis& diagnosis, Length length) {
  return DrawText(DiagnosisDocument(diagnosis), length);
}

std::string BriefDiagnosis(const Diagnosis& diagnosis) {
  const Verdict& verdict = diagnosis.verdict;
  std::string text;
  for (const Cause& cause : verdict.causes)
    text += (text.empty() ? "" : "; ") + BriefCause(diagnosis, cause);
  if (text.empty()) {
    text = FullSentence(verdict.sentence);
  } else {
    text += fmt::format("; misfit {:.2f} -> {:.2f} % of Isc", 100 * verdict.lack_of_fit.value,
                        100 * verdict.remaining.value);
  }
  text += BriefMarks(diagnosis.interrupted, diagnosis.extended.usable, diagnosis.warnings.size());
  return diagnosis.name + ": " + text + "\n";
}

}  // namespace lyrefit
