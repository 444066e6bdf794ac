#include "lyrefit/report/json_report.h"

#include "lyrefit/report/fit_json_parts.h"
#include "lyrefit/report/law_json.h"

namespace lyrefit {
namespace {

Json ParametersJson(const FitReport& report) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    const Estimate& e = report.estimates[i];
    Json& parameter = parameters[e.info.name] = EstimateJson(e, report.polished);
    if (report.under_errors.empty()) continue;
    const Estimate& under = report.under_errors[i];
    parameter["under_errors"] = {{"standard_error", Number(under.standard_error)},
                                 {"low_95", Number(under.low_95)},
                                 {"high_95", Number(under.high_95)},
                                 {"interval", ToText(under.interval)}};
  }
  return parameters;
}

// Null for the models that pvlib's function does not know; of a model with effects, its base.
Json SingleDiodeJson(const FitReport& report) {
  if (report.model != Model::kSingleDiode || report.refined.size() < 5) return nullptr;
  return {{"photocurrent", Number(report.refined[kIph])},
          {"saturation_current", Number(report.refined[SaturationCurrentIndex(0)])},
          {"resistance_series", Number(report.refined[kRs])},
          {"resistance_shunt", Number(report.refined[kRsh])},
          {"nNsVth", Number(report.nNsVth)}};
}

Json RmseJson(const FitReport& report) {
  const auto pair = [](const RmsePair& rmse, bool known) {
    return RmsePairJson(known ? rmse : RmsePair{});
  };
  return {{"random_baseline", pair(report.rmse.random_baseline, true)},
          {"searched", pair(report.rmse.searched, true)},
          {"plain_polished", pair(report.rmse.plain_polished, true)},
          {"least_squares", pair(report.errors ? report.errors->least_squares : RmsePair{}, true)},
          {"best_bird_polished", pair(report.rmse.best_bird_polished, report.polished)},
          {"refined", pair(report.rmse.refined, report.polished)}};
}

// Null where it was not asked for.
Json FloorJson(const FitReport& report) {
  if (!report.floor) return nullptr;
  const FloorReport& floor = *report.floor;
  return {{"measured_current_rmse_A", Number(floor.rmse_A)},
          {"lower_bound_A", Number(floor.lower_bound_A)},
          {"n_lower", Number(floor.n_lower)},
          {"n_upper", Number(floor.n_upper)},
          {"refined_above", Number(floor.above)}};
}

// Null where there are no effects.
Json BasinsJson(const std::optional<BasinCount>& basins) {
  if (!basins) return nullptr;
  const BasinCount::Independent& independent = basins->independent;
  return {{"ends", basins->ends},
          {"basins", basins->basins},
          {"best_visits", basins->best_visits},
          {"independent",
           {{"ends", independent.ends},
            {"basins", independent.basins},
            {"best_visits", independent.best_visits},
            {"once", independent.once},
            {"twice", independent.twice}}},
          {"unseen", Number(basins->unseen)}};
}

Json RefineJson(const RefineReport& refine) {
  Json starts = Json::array();
  for (const StartReport& start : refine.starts) {
    starts.push_back({{"origin", start.origin},
                      {"start_rmse_A", Number(start.start_rmse_A)},
                      {"end_rmse_A", Number(start.end_rmse_A)},
                      {"agrees", start.agrees}});
  }
  return {{"termination", refine.termination},
          {"message", refine.message},
          {"starts", refine.starts.size()},
          {"agreeing", refine.agreeing},
          {"winner", refine.winner < 0 ? Json(nullptr) : Json(refine.winner)},
          {"projected_gradient", Number(refine.projected_gradient)},
          {"condition", Number(refine.condition)},
          {"seconds", Number(refine.seconds)},
          {"basins", BasinsJson(refine.basins)},
          {"start_list", std::move(starts)}};
}

Json ChoiceJson(const std::optional<ModelChoice>& choice) {
  if (!choice) return nullptr;
  Json candidates = Json::array();
  for (const CandidateReport& c : choice->candidates) {
    candidates.push_back({{"model", ToText(c.model)},
                          {"rmse_A", Number(c.rmse_A)},
                          {"held_out_rmse_A", Number(c.held_out_rmse_A)},
                          {"aicc", Number(c.aicc)},
                          {"f_p_value", Number(c.f_p_value)},
                          {"identifiable", c.identifiable}});
  }
  return {{"chosen", ToText(choice->chosen)},
          {"sentence", choice->sentence},
          {"candidates", std::move(candidates)}};
}

// Null where there was nothing to choose from.
Json FormsJson(const std::vector<FormReport>& forms) {
  if (forms.empty()) return nullptr;
  Json list = Json::array();
  for (const FormReport& form : forms) {
    list.push_back({{"what", form.what},
                    {"free", form.free},
                    {"solved_current_rmse_A", Number(form.rmse_A)},
                    {"bic_above", Number(form.bic_above)},
                    {"finished", form.finished},
                    {"chosen", form.chosen}});
  }
  return list;
}

// What came out.
void AddAnswer(const FitReport& report, Json* json) {
  Json& j = *json;
  j["parameters"] = ParametersJson(report);
  j["nNsVth"] = Number(report.nNsVth);
  j["singlediode"] = SingleDiodeJson(report);
  j["rmse"] = RmseJson(report);
  j["errors"] = ErrorsJson(report.errors);
  j["floor"] = FloorJson(report);
  j["largest_error"] = LargestErrorJson(report.residuals);
  j["key_points"] = {{"measured", KeyPointsJson(report.measured)},
                     {"simulated", KeyPointsJson(report.simulated)}};
}

// How it was found and how far to trust it.
void AddEvidence(const FitReport& report, Json* json) {
  Json& j = *json;
  j["information"] = {{"points", report.criteria.points},
                      {"parameters", report.criteria.parameters},
                      {"aicc", Number(report.criteria.aicc)},
                      {"bic", Number(report.criteria.bic)}};
  j["residuals"] = ResidualsJson(report.residuals);
  j["correlations"] = CorrelationsJson(report.correlations);
  j["search"] = SearchJson(report.search_options, report.search, report.curve_evaluations);
  j["refine"] = RefineJson(report.refine);
  j["intervals"] = {{"seconds", Number(report.interval_seconds)},
                    {"none_because", report.no_intervals_because}};
  j["model_choice"] = ChoiceJson(report.choice);
  j["forms"] = FormsJson(report.forms);
  j["options"] = OptionsJson(report.non_default_options);
  j["interrupted"] = report.interrupted;
  j["usable"] = report.usable;
  j["not_usable_because"] = report.not_usable_because;
  j["warnings"] = report.warnings;
}

// Every n-th value and the last.
Json Thinned(const std::vector<double>& values, std::size_t every) {
  Json list = Json::array();
  for (std::size_t i = 0; i < values.size(); i += every) list.push_back(Number(values[i]));
  if (!values.empty() && (values.size() - 1) % every != 0) list.push_back(Number(values.back()));
  return list;
}

Json DataJson(const FitReport& report, JsonPoints points) {
  const std::size_t all = report.curve.size();
  const bool thin = points == JsonPoints::kThinned && all > kMostJsonPoints;
  const std::size_t every = thin ? (all + kMostJsonPoints - 1) / kMostJsonPoints : 1;
  Json json = {{"voltage_V", Thinned(report.curve.voltage_V, every)},
               {"current_A", Thinned(report.curve.current_A, every)},
               {"model_current_A", Thinned(report.model_current_A, every)},
               {"residual_A", Thinned(report.residual_A, every)}};
  if (!thin) return json;
  json["points"] = all;
  json["every"] = every;
  return json;
}

// Effects beside the diodes. Of the measurement in which they act all readings are kept.
Json LawJson(const FitReport& report) {
  const Extension& extension = *report.device.extension;
  if (extension.set != nullptr) return SetLawJson(extension.uses, *extension.set, &extension);
  const IvCurve& curve = report.curve;
  Json law = {
      {"effects", report.causes},
      {"bypass_diodes", curve.notes.bypass_diodes ? Json(*curve.notes.bypass_diodes) : Json()}};
  if (!curve.time_s.empty()) law["time_s"] = curve.time_s;
  if (!curve.irradiance_W_m2.empty()) law["irradiance_Wm2"] = curve.irradiance_W_m2;
  return law;
}

}  // namespace

Json FitJson(const FitReport& report, JsonPoints points) {
  Json json;
  json["lyrefit_version"] = report.version;
  json["curve"] = CurveJson(report.curve);
  json["model"] = ToText(report.model);
  json["objective"] = ToText(report.objective);
  json["constants"] = ToText(report.constants);
  json["bounds"] = report.bounds_name;
  if (!report.causes.empty()) json["causes"] = report.causes;
  if (report.curves > 1) json["curves"] = report.curves;
  const bool extended = report.device.extension != nullptr;
  if (extended) json["law"] = LawJson(report);
  if (extended) points = JsonPoints::kAll;
  AddAnswer(report, &json);
  AddEvidence(report, &json);
  json["data"] = DataJson(report, points);
  return json;
}

std::string JsonReport(const FitReport& report, JsonPoints points) {
  // Names and files may hold bytes that are not UTF-8.
  return JsonText(FitJson(report, points));
}

}  // namespace lyrefit
