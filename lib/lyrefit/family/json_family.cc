#include "lyrefit/family/family_documents.h"
#include "lyrefit/family/family_parts.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

// An interval, or null if it was not requested.
void to_json(Json& j, const Interval& interval) {
  j = nullptr;
  if (std::isnan(interval.value)) return;
  j = {{"value", interval.value},
       {"standard_error", interval.standard_error},
       {"low_95", interval.low_95},
       {"high_95", interval.high_95}};
}

void to_json(Json& j, const FamilyErrors& errors) {
  j["kind"] = errors.kind;
  j["current_noise_A"] = errors.sizes.readings.current_A;
  j["voltage_noise_V"] = errors.sizes.readings.voltage_V;
  j["path_of_isc"] = errors.sizes.readings.path;
  j["path_power_of_light"] = errors.path_power;
  j["curve_irradiance_part"] = errors.sizes.irradiance;
  j["curve_temperature_K"] = errors.sizes.temperature_K;
  LYREFIT_PUT_FIELDS(j, errors, judge, tested_curves, gain);
}

void to_json(Json& j, const HeldOut& held_out) {
  LYREFIT_PUT_FIELDS(j, held_out, how, curves, rmse);
  j["median_solved_current_A"] = held_out.median_rmse_A;
  j["largest_solved_current_A"] = held_out.largest_rmse_A;
  j["largest_id"] = held_out.largest_id;
  j["median_individual_solved_current_A"] = held_out.median_individual_rmse_A;
}

void to_json(Json& j, const Against& against) {
  j = {{"name", against.name}, {"law", against.law}};
  j.update(Json(against.result));
  j.erase("how");  // equal to that of the joint fit
  j.erase("median_individual_solved_current_A");
}

void to_json(Json& j, const FamilyCandidate& c) {
  LYREFIT_PUT_FIELDS(j, c, law, model, rmse);
  j["held_out_solved_current_A"] = c.held_out_rmse_A;
  j["held_out_median_solved_current_A"] = c.held_out_median_A;
  j["behind_best_standard_errors"] = c.behind_best;
  LYREFIT_PUT_FIELDS(j, c, free_parameters, chosen);
}

void to_json(Json& j, const RejectedCurve& curve) {
  j = {{"id", curve.id}, {"error", curve.error.ToString()}};
}

LYREFIT_JSON_FIELDS(OutlierCell, id, point, unit, measured, expected)

LYREFIT_JSON_FIELDS(KeyPointFit, measured, model, held_out_power_W)

LYREFIT_JSON_FIELDS(KeyPointErrors, short_circuit_current, open_circuit_voltage, max_power_voltage,
                    max_power, temperature_K, irradiance)

void to_json(Json& j, const KeyPointSummary& summary) {
  LYREFIT_PUT_FIELDS(j, summary, errors, found, scale);
  j["rms"] = Json{{"short_circuit_current", summary.short_circuit_current},
                  {"open_circuit_voltage", summary.open_circuit_voltage},
                  {"max_power_current", summary.max_power_current},
                  {"max_power_voltage", summary.max_power_voltage},
                  {"max_power", summary.max_power},
                  {"max_power_of_reference", summary.max_power_of_reference},
                  {"held_out_max_power_of_reference", summary.held_out_max_power_of_reference}};
  LYREFIT_PUT_FIELDS(j, summary, reference_power_W, held_out, covered);
}

namespace {

// The values of a parameter vector by name.
Json ValuesJson(const std::vector<ParameterInfo>& infos, const std::vector<double>& values);

Json FamilyRmseJson(const FamilyReport& report) {
  const auto over = [](const RmsePair& pair, const char* curves) {
    Json json = pair;
    json["curves"] = curves;
    return json;
  };
  Json j = {{"random_baseline", over(report.rmse.random_baseline, "search")},
            {"searched", over(report.rmse.searched, "search")},
            {"searched_all", over(report.searched_all, "fitted")},
            {"refined", over(report.rmse.refined, "fitted")}};
  if (std::isnan(report.refined_key_points)) return j;
  j["searched_key_points"] = report.searched_key_points;
  j["refined_key_points"] = report.refined_key_points;
  return j;
}

Json EqualDevicesJson(const FamilyReport& report) {
  if (!report.equal_devices) return nullptr;
  Json devices = Json::array();
  for (const EqualDevice& one : report.equal_devices->devices) {
    devices.push_back({{"parameters", ValuesJson(report.translation.parameters, one.shared)},
                       {"rise", one.rise},
                       {"reference_power_W", one.reference_power_W},
                       {"low_light_power_W", one.low_light_power_W},
                       {"hot_power_W", one.hot_power_W}});
  }
  return {{"along", report.equal_devices->along}, {"devices", devices}};
}

Json SharedJson(const FamilyReport& report) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    Json one = report.estimates[i];
    one["jackknife"] = i < report.jackknife.size() ? Json(report.jackknife[i]) : Json();
    one["under_errors"] = i < report.under_errors.size() ? Json(report.under_errors[i]) : Json();
    parameters[ParameterKey(report.estimates[i].info)] = std::move(one);
  }
  return parameters;
}

// Values only, by the keys of their parameters.
Json ValuesJson(const std::vector<ParameterInfo>& infos, const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  Json json = Json::object();
  for (std::size_t i = 0; i < infos.size() && i < values.size(); ++i) {
    json[ParameterKey(infos[i])] = values[i];
  }
  return json;
}

Json FamilyCurveJson(const FamilyCurve& curve, const std::vector<ParameterInfo>& device) {
  return {{"id", curve.id},
          {"role", curve.role},
          {"reason", curve.reason},
          {"outlier", curve.outlier},
          {"points", curve.points},
          {"irradiance_Wm2", curve.irradiance_W_m2},
          {"irradiance_known", curve.irradiance_known},
          {"irradiance_offset_Wm2", curve.irradiance_offset_W_m2},
          {"temperature_C", curve.temperature_C},
          {"temperature_known", curve.temperature_known},
          {"temperature_offset_K", curve.temperature_offset_K},
          {"short_circuit_current_A", curve.short_circuit_current_A},
          {"parameters", ValuesJson(device, curve.parameters)},
          {"rmse", curve.rmse},
          {"individual_parameters", ValuesJson(device, curve.individual_parameters)},
          {"individual_rmse", curve.individual_rmse},
          {"isc_excess", curve.isc_excess},
          {"voc_excess_V", curve.voc_excess_V},
          {"key_points", curve.key_points},
          {"mean_residual_A", curve.mean_residual_A},
          {"residual_A", curve.residual_A}};
}

Json FamilyCurvesJson(const FamilyReport& report) {
  std::vector<ParameterInfo> device = report.translation.device.parameters;
  if (device.empty()) device = FreeInfos(report);
  Json curves = Json::array();
  for (const FamilyCurve& curve : report.curves) curves.push_back(FamilyCurveJson(curve, device));
  return curves;
}

Json WithoutOutliersJson(const FamilyReport& report) {
  if (!report.without_outliers) return nullptr;
  const WithoutOutliers& without = *report.without_outliers;
  return {{"ids", without.ids},
          {"cells", without.cells},
          {"rmse", without.rmse},
          {"parameters", ValuesJson(report.translation.parameters, without.shared)}};
}

Json CoefficientsJson(const FamilyReport& report) {
  Json coefficients = Json::object();
  for (const Coefficient& c : report.coefficients) {
    coefficients[c.name] = {{"unit", c.unit}, {"interval", c.value}};
  }
  return coefficients;
}

// Adds the results.
void AddFamilyAnswer(const FamilyReport& report, Json* json) {
  const TranslationSpec& spec = report.translation.spec;
  const bool shared = !report.estimates.empty();  // else each curve has its own parameters
  Json& j = *json;
  j["family"] = shared ? ToText(spec.law) : "free";
  j["model"] = spec.model;
  j["shunt"] = shared ? Json(spec.shunt) : Json();
  j["recombination"] = spec.recombination;
  j["cells_in_series"] = report.cells_in_series;
  j["objective"] = report.objective;
  j["constants"] = spec.constants;
  j["parameters"] = SharedJson(report);
  j["sensor_offsets"] = {{"irradiance_Wm2", report.irradiance_offset_W_m2},
                         {"temperature_K", report.temperature_offset_K}};
  j["temperature_coefficients"] = CoefficientsJson(report);
  j["reference"] = shared ? Json(report.reference) : Json();
  j["rmse"] = FamilyRmseJson(report);
  j["residuals"] = report.key_points ? "key-points" : "currents";
  j["key_points"] = report.key_points;
  j["equal_devices"] = EqualDevicesJson(report);
  j["noise_A"] = report.noise_A;
  j["weights"] = report.weights;
  j["weights_gain"] = report.weights_gain;
  j["errors"] = report.errors;
}

// Adds the reliability of the results.
void AddFamilyEvidence(const FamilyReport& report, Json* json) {
  Json& j = *json;
  j["held_out"] = report.held_out;
  j["against"] = report.against;
  j["in_sample"] = report.in_sample;
  j["without_outliers"] = WithoutOutliersJson(report);
  j["candidates"] = report.candidates;
  j["correlations"] = report.correlations;
  j["search"] = SearchJson(report.search_options, report.search, report.search.evaluations);
  j["search"]["curves"] = report.search_ids;
  j["refine"] = {{"termination", report.refine.termination},
                 {"projected_gradient", report.refine.projected_gradient}};
  j["seconds"] = report.seconds;
  j["individual_fits"] = {{"seconds", report.individual_seconds}};
  j["options"] = report.non_default_options;
  j["rejected"] = report.rejected;
  j["assumptions"] = report.assumptions;
  j["warnings"] = report.warnings;
  j["interrupted"] = report.interrupted;
  j["usable"] = report.usable;
}

}  // namespace

void to_json(Json& j, const FamilyReport& report) {
  j = {{"lyrefit_version", report.version},
       {"set", {{"name", report.name}, {"source", report.source}}}};
  if (report.taken != nullptr) {
    const std::optional<Device>& extended = report.translation.extended;
    j["law"] = SetLawJson(report.with, *report.taken,
                          extended && !report.refined.empty() ? &*extended->effects : nullptr);
    j["causes"] = j["law"]["effects"];
  }
  AddFamilyAnswer(report, &j);
  AddFamilyEvidence(report, &j);
  j["curves"] = FamilyCurvesJson(report);
}

std::string FamilyJson(const FamilyReport& report) { return Dump(report); }

}  // namespace lyrefit
