#include "lyrefit/report/estimate_parts.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

LYREFIT_JSON_FIELDS(StartReport, origin, start_rmse_A, end_rmse_A, agrees)
LYREFIT_JSON_FIELDS(OptimumCount::Independent, ends, local_optima, best_visits, once, twice)
LYREFIT_JSON_FIELDS(OptimumCount, ends, local_optima, best_visits, independent, unseen)
LYREFIT_JSON_FIELDS(CandidateReport, model, rmse_A, held_out_rmse_A, aicc, f_p_value, identifiable)
LYREFIT_JSON_FIELDS(ModelChoice, chosen, sentence, candidates)
LYREFIT_JSON_FIELDS(InformationCriteria, points, parameters, aicc, bic)

void to_json(Json& j, const FloorReport& floor) {
  j = {{"objective", ToText(floor.objective)},
       {"rmse_A", floor.rmse_A},
       {"lower_bound_A", floor.lower_bound_A},
       {"gap", floor.gap},
       {"n_lower", floor.n_lower},
       {"n_upper", floor.n_upper},
       {"refined_above", floor.above},
       {"minimised", floor.minimised}};
}

void to_json(Json& j, const RefineReport& refine) {
  j = {{"termination", refine.termination},
       {"message", refine.message},
       {"starts", refine.starts.size()},
       {"agreeing", refine.agreeing},
       {"winner", refine.winner < 0 ? Json() : Json(refine.winner)},
       {"projected_gradient", refine.projected_gradient},
       {"condition", refine.condition},
       {"seconds", refine.seconds},
       {"local_optima", refine.local_optima},
       {"start_list", refine.starts}};
}

void to_json(Json& j, const VariantReport& variant) {
  j = {{"what", variant.what},
       {"free", variant.free},
       {"solved_current_rmse_A", variant.rmse_A},
       {"bic_above", variant.bic_above},
       {"finished", variant.finished},
       {"chosen", variant.chosen}};
}

namespace {

Json FitParametersJson(const FitReport& report) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    const Estimate& e = report.estimates[i];
    Json& parameter = parameters[ParameterKey(e.info)] = e;
    if (!report.polished) parameter["refined"] = nullptr;
    if (report.under_errors.empty()) continue;
    const Estimate& under = report.under_errors[i];
    parameter["under_errors"] = {{"standard_error", under.standard_error},
                                 {"low_95", under.low_95},
                                 {"high_95", under.high_95},
                                 {"interval", under.interval}};
  }
  return parameters;
}

// pvlib's arguments; null for models that its function does not support. With effects, the base
// model.
Json SingleDiodeJson(const FitReport& report) {
  if (report.model != Model::kSingleDiode || report.refined.size() < 5) return nullptr;
  return {{"photocurrent", report.refined[kIph]},
          {"saturation_current", report.refined[SaturationCurrentIndex(0)]},
          {"resistance_series", report.refined[kRs]},
          {"resistance_shunt", report.refined[kRsh]},
          {"nNsVth", report.nNsVth}};
}

Json FitRmseJson(const FitReport& report) {
  const RmsePair unknown;
  const RmseTable& rmse = report.rmse;
  return {{"random_baseline", rmse.random_baseline},
          {"searched", rmse.searched},
          {"plain_polished", rmse.plain_polished},
          {"least_squares", report.errors ? report.errors->least_squares : unknown},
          {"refined_best_candidate", report.polished ? rmse.refined_best_candidate : unknown},
          {"refined", report.polished ? rmse.refined : unknown}};
}

// The effects besides the diodes, with all readings of the measurement that they act on.
Json FitLawJson(const FitReport& report) {
  const DeviceEffects& device_effects = *report.device.effects;
  if (device_effects.set != nullptr)
    return SetLawJson(device_effects.uses, *device_effects.set, &device_effects);
  const IvCurve& curve = report.curve;
  Json law = {{"effects", report.causes}, {"bypass_diodes", curve.notes.bypass_diodes}};
  if (!curve.time_s.empty()) law["time_s"] = curve.time_s;
  if (!curve.irradiance_W_m2.empty()) law["irradiance_Wm2"] = curve.irradiance_W_m2;
  return law;
}

// Every n-th value and the last.
std::vector<double> Thinned(const std::vector<double>& values, std::size_t every) {
  std::vector<double> thin;
  for (std::size_t i = 0; i < values.size(); i += every) thin.push_back(values[i]);
  if (!values.empty() && (values.size() - 1) % every != 0) thin.push_back(values.back());
  return thin;
}

Json DataJson(const FitReport& report, JsonPoints points) {
  const std::size_t all = report.curve.size();
  const bool extended = report.device.effects != nullptr;  // its measurement is part of the law
  const bool thin = points == JsonPoints::kThinned && !extended && all > kMostJsonPoints;
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

// Adds inputs and results of the fit.
Json FitAnswerJson(const FitReport& report) {
  Json j = {{"lyrefit_version", report.version},
            {"curve", report.curve},
            {"model", report.model},
            {"objective", report.objective},
            {"constants", report.constants},
            {"bounds", report.bounds_name}};
  if (!report.causes.empty()) j["causes"] = report.causes;
  if (report.curves > 1) j["curves"] = report.curves;
  if (report.device.effects != nullptr) j["law"] = FitLawJson(report);
  j["parameters"] = FitParametersJson(report);
  j["nNsVth"] = report.nNsVth;
  j["singlediode"] = SingleDiodeJson(report);
  j["rmse"] = FitRmseJson(report);
  j["errors"] = report.errors;
  j["floor"] = report.floor;
  j["largest_error"] = LargestErrorJson(report.residuals);
  j["key_points"] = {{"measured", report.measured}, {"simulated", report.simulated}};
  return j;
}

}  // namespace

Json FitJson(const FitReport& report, JsonPoints points) {
  Json j = FitAnswerJson(report);
  // Search and reliability.
  j["information"] = report.criteria;
  j["residuals"] = report.residuals;
  j.update(CourseJson(report));
  j["model_choice"] = report.choice;
  j["variants"] = report.variants.empty() ? Json() : Json(report.variants);
  j["options"] = report.non_default_options;
  j["interrupted"] = report.interrupted;
  j["usable"] = report.usable;
  j["not_usable_because"] = report.not_usable_because;
  j["warnings"] = report.warnings;
  j["data"] = DataJson(report, points);
  return j;
}

std::string JsonReport(const FitReport& report, JsonPoints points) {
  return Dump(FitJson(report, points));
}

std::string FitsJson(const std::vector<FittedFile>& fits, JsonPoints points) {
  Json list = Json::array();
  for (const FittedFile& fit : fits) {
    Json item = {{"file", fit.file}};
    if (fit.report) {
      item.update(FitJson(*fit.report, points));
    } else {
      item["error"] = fit.report.error().ToString();
    }
    list.push_back(std::move(item));
  }
  return Dump(list);
}

}  // namespace lyrefit
