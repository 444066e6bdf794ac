#include <fmt/format.h>

#include "lyrefit/base/version.h"
#include "lyrefit/diagnose/diagnosis_documents.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

LYREFIT_JSON_FIELDS(Finding, id, sentence, points)
LYREFIT_JSON_FIELDS(Sized, value, low_95, high_95)
LYREFIT_JSON_FIELDS(Alternative, id, title, probability)
LYREFIT_JSON_FIELDS(CannotBeExcluded, id, biases, sentence, separate_by)
LYREFIT_JSON_FIELDS(ReferenceRow, symbol, name, unit, now, expected, low_95, high_95, z,
                    corrected_p, power, differs)

void to_json(Json& j, const ReferenceCause& cause) {
  const CauseParameter& size = cause.strength.front();
  LYREFIT_PUT_FIELDS(j, cause, id, sentence);
  j["size"] = size.value;
  LYREFIT_PUT_FIELDS(j, size, low_95, high_95, unit);
  j["power"] = -cause.power_effect.value;
  j["explained"] = cause.explained;
}

LYREFIT_JSON_FIELDS(ReferenceComparison, name, differs, p_value, sentence, rows, causes, references,
                    left_out, regressed_on, common, warnings)

void to_json(Json& j, const Evidence& evidence) {
  j["kind"] = evidence.kind;
  j["noise"] =
      Json{{"constant_A", evidence.noise_constant_A}, {"relative", evidence.noise_relative},
           {"voltage_V", evidence.noise_voltage_V},   {"dark_A", evidence.noise_dark_A},
           {"stated_A", evidence.noise_stated_A},     {"path_A", evidence.noise_path_A}};
  LYREFIT_PUT_FIELDS(j, evidence, misfit_ratio, autocorrelation, grid_step_A, grid_step_V,
                     clipped_points, clip_level_A);
  j["largest_error"] = LargestErrorJson(evidence.residuals);
  LYREFIT_PUT_FIELDS(j, evidence, residuals, whiteness_p_value, whiteness_after_p_value, findings);
}

namespace {

// Parameters of an effect.
Json CauseParametersJson(const std::string& effect, const std::vector<CauseParameter>& parameters) {
  Json list = Json::array();
  for (const CauseParameter& p : parameters) {
    Json one = EffectParameterJson(effect, p.symbol, p.name, p.unit);
    LYREFIT_PUT_FIELDS(one, p, value, low_95, high_95, at_bound);
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace

void to_json(Json& j, const Trial& trial) {
  LYREFIT_PUT_FIELDS(j, trial, effect, title, tried);
  j["why_not"] = trial.tried ? Json() : Json(trial.why_not);
  LYREFIT_PUT_FIELDS(j, trial, rmse_A, misfit, log_evidence, probability, probability_material,
                     delta_aicc, held_out_rmse_A, kept);
  j["parameters"] = CauseParametersJson(trial.effect, trial.parameters);
}

void to_json(Json& j, const Cause& cause) {
  LYREFIT_PUT_FIELDS(j, cause, id, effect, title, sentence, in_words, current_effect, power_effect,
                     recoverable_power_W, at_least, probability, alternatives, mechanisms, group,
                     action, fact_sheet, equivalents, separate_by);
  j["parameters"] = CauseParametersJson(cause.effect, cause.strength);
  LYREFIT_PUT_FIELDS(j, cause, evidence, acts, points);
}

LYREFIT_JSON_FIELDS(ResistanceLoss, part, usual, most, beyond_W, rise)
LYREFIT_JSON_FIELDS(FillFactor, value, usual, least, lost_W, lost, if_silicon)
LYREFIT_JSON_FIELDS(Verdict, found, unexplained, sentence, causes, below_floor, lack_of_fit,
                    remaining, comparison, probability_none, resistance_loss, fill_factor,
                    recoverable_power_W, cannot_be_excluded, not_shown)

void to_json(Json& j, const DeviceFinding& finding) {
  LYREFIT_PUT_FIELDS(j, finding, id, symbol);
  LYREFIT_PUT_FIELDS(j, finding.value, value, low_95, high_95);
  LYREFIT_PUT_FIELDS(j, finding, healthy_limit, power_loss, sentence);
  const Cause cause = CauseOf(finding);
  j["title"] = cause.title;
  j["about"] = cause.group;
  j["action"] = cause.action;
  j["separate_by"] = cause.separate_by;
  j["recoverable_power_W"] = finding.recoverable_power_W;
}

void to_json(Json& j, const ParameterShift& shift) {
  j = ParameterInfo{shift.symbol, shift.name, shift.unit, ""};
  j.update(
      {{"before", shift.before}, {"after", shift.after}, {"standard_error", shift.standard_error}});
}

void to_json(Json& j, const Gain& gain) {
  LYREFIT_PUT_FIELDS(j, gain, rmse_before_A, rmse_after_A, held_out_before_A, held_out_after_A,
                     held_out_gain_A2, held_out_gain_error_A2, folds, by_sweeps, gain, sentence);
  j["parameter_shift"] = gain.shifts;
}

void to_json(Json& j, const JudgedSetup& setup) {
  j = {{"name", ToText(setup.setup)}, {"from", setup.from}, {"source", setup.source}};
}

void to_json(Json& j, const DiagnosedCurve& curve) {
  j["name"] = curve.name;
  j["irradiance_Wm2"] = curve.irradiance_W_m2;
  LYREFIT_PUT_FIELDS(j, curve, temperature_C, dark, points);
}

namespace {

// Points as columns, like the data of other reports.
Json PointsJson(const std::vector<DiagnosedPoint>& points) {
  const auto column = [&points](auto field) {
    Json list = Json::array();
    for (const DiagnosedPoint& point : points) list.push_back(point.*field);
    return list;
  };
  return {{"curve", column(&DiagnosedPoint::curve)},
          {"segment", column(&DiagnosedPoint::segment)},
          {"voltage_V", column(&DiagnosedPoint::voltage_V)},
          {"current_A", column(&DiagnosedPoint::current_A)},
          {"sigma_A", column(&DiagnosedPoint::sigma_A)},
          {"before_A", column(&DiagnosedPoint::before_A)},
          {"after_A", column(&DiagnosedPoint::after_A)},
          {"without_causes_A", column(&DiagnosedPoint::without_A)},
          {"time_s", column(&DiagnosedPoint::time_s)}};
}

}  // namespace

void to_json(Json& j, const Diagnosis& diagnosis) {
  j["lyrefit_version"] = diagnosis.version;
  LYREFIT_PUT_FIELDS(j, diagnosis, name, source, base, base_sentence);
  j["objective"] = Objective::kSolvedCurrent;
  LYREFIT_PUT_FIELDS(j, diagnosis, seed, probability, floor_current, floor_power, setup, verdict,
                     device_findings, gain);
  j["evidence"] = diagnosis.evidence;
  j["trials"] = diagnosis.trials;
  j["non_default_options"] = diagnosis.non_default_options;
  j["assumptions"] = diagnosis.assumptions;
  j["warnings"] = diagnosis.warnings;
  j["interrupted"] = diagnosis.interrupted;
  j["usable"] = diagnosis.extended.usable;
  j["seconds"] = diagnosis.seconds;
  j["curves"] = diagnosis.curves;
  j["points"] = PointsJson(diagnosis.points);
}

std::string DiagnosisJson(const Diagnosis& diagnosis) { return Dump(diagnosis); }

std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses) { return Dump(diagnoses); }

std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses) {
  Json answers = Json::object();
  for (std::size_t i = 0; i < names.size() && i < diagnoses.size(); ++i) {
    Json causes = Json::array();
    for (const Cause& cause : diagnoses[i].verdict.causes) {
      std::vector<std::string> ids = {cause.id};
      ids.insert(ids.end(), cause.equivalents.begin(), cause.equivalents.end());
      causes.push_back(std::move(ids));
    }
    answers[names[i]] = std::move(causes);
  }
  return Dump(answers);
}

std::string ReferenceJson(const ReferenceComparison& comparison, const Diagnosis& diagnosis) {
  return Dump(
      {{"lyrefit_version", Version()}, {"comparison", comparison}, {"diagnosis", diagnosis}});
}

std::string OutlierSweepsJson(const OutlierSweeps& outliers) {
  return Dump({{"lyrefit_version", Version()},
               {"outliers", outliers.outlier},
               {"sweeps", outliers.sweeps},
               {"rejected", outliers.rejected}});
}

namespace {

std::string YesNo(bool value) { return value ? "yes" : "no"; }

// `sized`: a Sized, or a parameter of a cause.
template <class T>
std::string SizedFields(const T& sized) {
  return CsvField(sized.value) + "," + CsvField(sized.low_95) + "," + CsvField(sized.high_95);
}

std::string StrengthText(const Cause& cause) {
  std::vector<std::string> texts;
  for (const CauseParameter& p : cause.strength) {
    texts.push_back(p.symbol + "=" + CsvField(p.value) + (p.unit.empty() ? "" : " " + p.unit));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string CauseLine(const std::string& name, const Cause& cause, bool named) {
  return CsvLine({CsvField(name), CsvField(cause.id), CsvField(cause.title), YesNo(named),
                  SizedFields(cause.current_effect), SizedFields(cause.power_effect),
                  SizedFields(cause.recoverable_power_W), CsvField(cause.probability),
                  CsvField(StrengthText(cause)),
                  CsvField(fmt::format("{}", fmt::join(cause.equivalents, " "))),
                  CsvField(cause.sentence)});
}

}  // namespace

std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses) {
  std::string csv =
      "measurement,cause,title,named,current_effect,current_effect_low_95,current_effect_high_95,"
      "power_effect,power_effect_low_95,power_effect_high_95,recoverable_power_W,"
      "recoverable_power_W_low_95,recoverable_power_W_high_95,probability,strength,equivalents,"
      "sentence\n";
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    const Verdict& verdict = diagnoses[i].verdict;
    for (const Cause& cause : verdict.causes) csv += CauseLine(names[i], cause, true);
    for (const Cause& cause : verdict.below_floor) csv += CauseLine(names[i], cause, false);
    if (!verdict.causes.empty() || !verdict.below_floor.empty()) continue;
    csv += CsvLine({CsvField(names[i]), "", "", "no", ",,", ",,", ",,", "", "", "",
                    CsvField(verdict.sentence)});
  }
  return csv;
}

std::string OutlierSweepsCsv(const OutlierSweeps& outliers) {
  std::string csv = "sweep,differs,p_value,cause,size,low_95,high_95,unit,power,sentence\n";
  for (const ReferenceComparison& sweep : outliers.sweeps) {
    const ReferenceCause cause = sweep.causes.empty() ? ReferenceCause() : sweep.causes.front();
    const CauseParameter size = cause.strength.empty() ? CauseParameter() : cause.strength.front();
    csv += CsvLine({CsvField(sweep.name), YesNo(sweep.differs), CsvField(sweep.p_value),
                    CsvField(cause.id), SizedFields(size), CsvField(size.unit),
                    CsvField(-cause.power_effect.value), CsvField(sweep.sentence)});
  }
  return csv;
}

}  // namespace lyrefit
