#include "lyrefit/report/diagnosis_json.h"

#include "lyrefit/report/fit_json_parts.h"

namespace lyrefit {
namespace {

Json EvidenceJson(const Evidence& evidence) {
  Json findings = Json::array();
  for (const Finding& finding : evidence.findings) {
    findings.push_back(
        {{"id", finding.id}, {"sentence", finding.sentence}, {"points", finding.points}});
  }
  return {{"kind", evidence.kind},
          {"noise",
           {{"constant_A", Number(evidence.noise_constant_A)},
            {"relative", Number(evidence.noise_relative)},
            {"voltage_V", Number(evidence.noise_voltage_V)},
            {"dark_A", Number(evidence.noise_dark_A)},
            {"stated_A", Number(evidence.noise_stated_A)},
            {"path_A", Number(evidence.noise_path_A)}}},
          {"misfit_ratio", Number(evidence.misfit_ratio)},
          {"autocorrelation", Number(evidence.autocorrelation)},
          {"grid_step_A", Number(evidence.grid_step_A)},
          {"grid_step_V", Number(evidence.grid_step_V)},
          {"clipped_points", evidence.clipped_points},
          {"clip_level_A", Number(evidence.clip_level_A)},
          {"largest_error", LargestErrorJson(evidence.residuals)},
          {"residuals", ResidualsJson(evidence.residuals)},
          {"whiteness_p_value", Number(evidence.whiteness_p_value)},
          {"whiteness_after_p_value", Number(evidence.whiteness_after_p_value)},
          {"findings", std::move(findings)}};
}

// One field of each parameter under its symbol.
template <class Field>
Json BySymbol(const std::vector<CauseParameter>& parameters, Field field) {
  Json json = Json::object();
  for (const CauseParameter& parameter : parameters) json[parameter.symbol] = field(parameter);
  return json;
}

Json TrialJson(const Trial& trial) {
  return {{"effect", trial.effect},
          {"title", trial.title},
          {"tried", trial.tried},
          {"why_not", trial.tried ? Json(nullptr) : Json(trial.why_not)},
          {"rmse_A", Number(trial.rmse_A)},
          {"misfit", Number(trial.misfit)},
          {"p_value", Number(trial.p_value)},
          {"corrected_p", Number(trial.corrected_p)},
          {"delta_aicc", Number(trial.delta_aicc)},
          {"held_out_rmse_A", Number(trial.held_out_rmse_A)},
          {"kept", Number(trial.kept)},
          {"parameters", BySymbol(trial.parameters, [](const CauseParameter& p) -> Json {
             return {{"name", p.name},
                     {"unit", p.unit},
                     {"value", Number(p.value)},
                     {"low_95", Number(p.low_95)},
                     {"high_95", Number(p.high_95)},
                     {"at_bound", p.at_bound}};
           })}};
}

Json SizedJson(const Sized& size) {
  return {{"value", Number(size.value)},
          {"low_95", Number(size.low_95)},
          {"high_95", Number(size.high_95)}};
}

Json CauseJson(const Cause& cause) {
  const auto value = [](const CauseParameter& p) { return Number(p.value); };
  const auto interval = [](const CauseParameter& p) { return Numbers({p.low_95, p.high_95}); };
  const auto unit = [](const CauseParameter& p) { return Json(p.unit); };
  const auto at_bound = [](const CauseParameter& p) { return Json(p.at_bound); };
  return {{"id", cause.id},
          {"title", cause.title},
          {"sentence", cause.sentence},
          {"in_words", cause.in_words},
          {"current_effect", SizedJson(cause.current_effect)},
          {"power_effect", SizedJson(cause.power_effect)},
          {"recoverable_power_W", Number(cause.recoverable_power_W)},
          {"equivalents", cause.equivalents},
          {"separate_by", cause.separate_by},
          {"strength", BySymbol(cause.strength, value)},
          {"interval", BySymbol(cause.strength, interval)},
          {"units", BySymbol(cause.strength, unit)},
          {"at_bound", BySymbol(cause.strength, at_bound)},
          {"corrected_p", Number(cause.corrected_p)},
          {"evidence", cause.evidence},
          {"acts", cause.acts},
          {"points", cause.points}};
}

Json VerdictJson(const Verdict& verdict) {
  Json causes = Json::array();
  for (const Cause& cause : verdict.causes) causes.push_back(CauseJson(cause));
  Json below = Json::array();
  for (const Cause& cause : verdict.below_floor) below.push_back(CauseJson(cause));
  Json others = Json::array();
  for (const CannotBeExcluded& cause : verdict.cannot_be_excluded) {
    others.push_back({{"id", cause.id},
                      {"biases", cause.biases},
                      {"sentence", cause.sentence},
                      {"separate_by", cause.separate_by}});
  }
  return {{"found", verdict.found},
          {"unexplained", verdict.unexplained},
          {"sentence", verdict.sentence},
          {"causes", std::move(causes)},
          {"below_floor", std::move(below)},
          {"departure", SizedJson(verdict.departure)},
          {"cannot_be_excluded", std::move(others)}};
}

Json GainJson(const Gain& gain) {
  Json shifts = Json::object();
  for (const ParameterShift& shift : gain.shifts) {
    shifts[shift.symbol] = {{"name", shift.name},
                            {"unit", shift.unit},
                            {"before", Number(shift.before)},
                            {"after", Number(shift.after)},
                            {"standard_error", Number(shift.standard_error)}};
  }
  return {{"rmse_before_A", Number(gain.rmse_before_A)},
          {"rmse_after_A", Number(gain.rmse_after_A)},
          {"held_out_before_A", Number(gain.held_out_before_A)},
          {"held_out_after_A", Number(gain.held_out_after_A)},
          {"held_out_gain_A2", Number(gain.held_out_gain_A2)},
          {"held_out_gain_error_A2", Number(gain.held_out_gain_error_A2)},
          {"folds", gain.folds},
          {"by_sweeps", gain.by_sweeps},
          {"gain", gain.gain},
          {"sentence", gain.sentence},
          {"parameter_shift", std::move(shifts)}};
}

Json PlanJson(const Plan& plan) {
  Json measurements = Json::array();
  for (const PlannedMeasurement& measurement : plan.measurements) {
    Json causes = Json::object();
    for (const PlannedCause& cause : measurement.causes) {
      causes[cause.id] = {{"probability", Number(cause.probability)},
                          {"separation", Number(cause.separation)},
                          {"nearest", cause.nearest}};
    }
    measurements.push_back({{"id", measurement.id},
                            {"title", measurement.title},
                            {"taken", measurement.taken},
                            {"probability", Number(measurement.probability)},
                            {"causes", std::move(causes)}});
  }
  return {{"causes", plan.causes},
          {"sentence", plan.sentence},
          {"measurements", std::move(measurements)}};
}

Json CurvesJson(const std::vector<DiagnosedCurve>& curves) {
  Json list = Json::array();
  for (const DiagnosedCurve& curve : curves) {
    list.push_back({{"name", curve.name},
                    {"irradiance_Wm2", Number(curve.irradiance_W_m2)},
                    {"temperature_C", Number(curve.temperature_C)},
                    {"dark", curve.dark},
                    {"points", curve.points}});
  }
  return list;
}

// Columns, as the data of other reports.
Json PointsJson(const std::vector<DiagnosedPoint>& points) {
  const auto column = [&points](auto field) {
    Json list = Json::array();
    for (const DiagnosedPoint& point : points) list.push_back(Number(point.*field));
    return list;
  };
  const auto counts = [&points](int DiagnosedPoint::*field) {
    Json list = Json::array();
    for (const DiagnosedPoint& point : points) list.push_back(point.*field);
    return list;
  };
  return {{"curve", counts(&DiagnosedPoint::curve)},
          {"segment", counts(&DiagnosedPoint::segment)},
          {"voltage_V", column(&DiagnosedPoint::voltage_V)},
          {"current_A", column(&DiagnosedPoint::current_A)},
          {"sigma_A", column(&DiagnosedPoint::sigma_A)},
          {"before_A", column(&DiagnosedPoint::before_A)},
          {"after_A", column(&DiagnosedPoint::after_A)},
          {"without_causes_A", column(&DiagnosedPoint::without_A)},
          {"time_s", column(&DiagnosedPoint::time_s)}};
}

Json ToJson(const Diagnosis& diagnosis) {
  Json trials = Json::array();
  for (const Trial& trial : diagnosis.trials) trials.push_back(TrialJson(trial));
  Json json;
  json["lyrefit_version"] = diagnosis.version;
  json["name"] = diagnosis.name;
  json["source"] = diagnosis.source;
  json["base"] = diagnosis.base;
  json["base_sentence"] = diagnosis.base_sentence;
  json["objective"] = "solved-current";
  json["seed"] = diagnosis.seed;
  json["level"] = Number(diagnosis.level);
  json["floor_current"] = Number(diagnosis.floor_current);
  json["floor_power"] = Number(diagnosis.floor_power);
  json["verdict"] = VerdictJson(diagnosis.verdict);
  json["gain"] = GainJson(diagnosis.gain);
  if (diagnosis.plan) json["plan"] = PlanJson(*diagnosis.plan);
  json["evidence"] = EvidenceJson(diagnosis.evidence);
  json["trials"] = std::move(trials);
  json["non_default_options"] = OptionsJson(diagnosis.non_default_options);
  json["assumptions"] = diagnosis.assumptions;
  json["warnings"] = diagnosis.warnings;
  json["interrupted"] = diagnosis.interrupted;
  json["usable"] = diagnosis.extended.usable;
  json["seconds"] = Number(diagnosis.seconds);
  json["curves"] = CurvesJson(diagnosis.curves);
  json["points"] = PointsJson(diagnosis.points);
  return json;
}

// Names and files may hold bytes that are not UTF-8.
std::string Dump(const Json& json) { return JsonText(json); }

}  // namespace

std::string DiagnosisJson(const Diagnosis& diagnosis) { return Dump(ToJson(diagnosis)); }

std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses) {
  Json list = Json::array();
  for (const Diagnosis& diagnosis : diagnoses) list.push_back(ToJson(diagnosis));
  return Dump(list);
}

std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses) {
  Json answers = Json::object();
  for (std::size_t i = 0; i < names.size() && i < diagnoses.size(); ++i) {
    Json causes = Json::array();
    for (const Cause& cause : diagnoses[i].verdict.causes) {
      Json ids = Json::array();
      ids.push_back(cause.id);
      for (const std::string& id : cause.equivalents) ids.push_back(id);
      causes.push_back(std::move(ids));
    }
    answers[names[i]] = std::move(causes);
  }
  return Dump(answers);
}

}  // namespace lyrefit
