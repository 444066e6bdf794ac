#include "lyrefit/report/family_json.h"

#include "lyrefit/report/family_sections.h"
#include "lyrefit/report/fit_json_parts.h"
#include "lyrefit/report/law_json.h"

namespace lyrefit {
namespace {

// Null where nobody asked for it.
Json IntervalJson(const Interval& interval) {
  if (std::isnan(interval.value)) return nullptr;
  return {{"value", Number(interval.value)},
          {"standard_error", Number(interval.standard_error)},
          {"low_95", Number(interval.low_95)},
          {"high_95", Number(interval.high_95)}};
}

Json SharedJson(const FamilyReport& report) {
  Json parameters = Json::object();
  for (std::size_t i = 0; i < report.estimates.size(); ++i) {
    const Estimate& e = report.estimates[i];
    Json one = EstimateJson(e, true);
    one["jackknife"] = i < report.jackknife.size() ? IntervalJson(report.jackknife[i]) : nullptr;
    const bool under = i < report.under_errors.size();
    one["under_errors"] = under ? IntervalJson(report.under_errors[i]) : nullptr;
    parameters[e.info.name] = std::move(one);
  }
  return parameters;
}

Json FamilyErrorsJson(const std::optional<FamilyErrors>& errors) {
  if (!errors) return nullptr;
  return {{"kind", ToText(errors->kind)},
          {"current_noise_A", Number(errors->sizes.readings.current_A)},
          {"voltage_noise_V", Number(errors->sizes.readings.voltage_V)},
          {"path_of_isc", Number(errors->sizes.readings.path)},
          {"path_power_of_light", Number(errors->path_power)},
          {"curve_irradiance_part", Number(errors->sizes.irradiance)},
          {"curve_temperature_K", Number(errors->sizes.temperature_K)},
          {"judge", ToText(errors->judge)},
          {"tested_curves", errors->tested_curves},
          {"gain", Number(errors->gain)}};
}

// Shared values by name, without what is known about them.
Json ValuesJson(const std::vector<ParameterInfo>& infos, const std::vector<double>& values) {
  if (values.empty()) return nullptr;
  Json json = Json::object();
  for (std::size_t i = 0; i < infos.size() && i < values.size(); ++i) {
    json[infos[i].name] = Number(values[i]);
  }
  return json;
}

Json CurveJson(const FamilyCurve& curve, const std::vector<ParameterInfo>& device) {
  return {{"id", curve.id},
          {"role", ToText(curve.role)},
          {"reason", curve.reason},
          {"odd", curve.odd},
          {"points", curve.points},
          {"irradiance_Wm2", Number(curve.irradiance_W_m2)},
          {"irradiance_known", curve.irradiance_known},
          {"irradiance_offset_Wm2", IntervalJson(curve.irradiance_offset_W_m2)},
          {"temperature_C", Number(curve.temperature_C)},
          {"temperature_known", curve.temperature_known},
          {"temperature_offset_K", IntervalJson(curve.temperature_offset_K)},
          {"short_circuit_current_A", Number(curve.short_circuit_current_A)},
          {"parameters", ValuesJson(device, curve.parameters)},
          {"rmse", RmsePairJson(curve.rmse)},
          {"free_parameters", ValuesJson(device, curve.free_parameters)},
          {"free_rmse", RmsePairJson(curve.free_rmse)},
          {"isc_excess", Number(curve.isc_excess)},
          {"voc_excess_V", Number(curve.voc_excess_V)},
          {"mean_residual_A", Number(curve.mean_residual_A)},
          {"residual_A", Numbers(curve.residual_A)}};
}

Json CurvesJson(const FamilyReport& report) {
  std::vector<ParameterInfo> device = report.translation.device.parameters;
  if (device.empty()) device = FreeInfos(report);
  Json curves = Json::array();
  for (const FamilyCurve& curve : report.curves) curves.push_back(CurveJson(curve, device));
  return curves;
}

Json RmseJson(const FamilyRmseTable& rmse) {
  const auto over = [](const RmsePair& pair, const char* curves) {
    Json json = RmsePairJson(pair);
    json["curves"] = curves;
    return json;
  };
  return {{"random_baseline", over(rmse.random_baseline, "search")},
          {"searched", over(rmse.searched, "search")},
          {"searched_all", over(rmse.searched_all, "fitted")},
          {"refined", over(rmse.refined, "fitted")}};
}

Json HeldOutJson(const std::optional<HeldOut>& held_out) {
  if (!held_out) return nullptr;
  return {{"how", held_out->how},
          {"curves", held_out->curves},
          {"rmse", RmsePairJson(held_out->rmse)},
          {"median_solved_current_A", Number(held_out->median_rmse_A)},
          {"largest_solved_current_A", Number(held_out->largest_rmse_A)},
          {"largest_id", held_out->largest_id},
          {"median_free_solved_current_A", Number(held_out->median_free_rmse_A)}};
}

Json AgainstJson(const std::vector<Against>& against) {
  Json list = Json::array();
  for (const Against& one : against) {
    Json json = {{"name", one.name}, {"law", one.law}};
    json.update(HeldOutJson(one.result));
    json.erase("how");  // as the joint fit
    json.erase("median_free_solved_current_A");
    list.push_back(std::move(json));
  }
  return list;
}

Json WithoutOddJson(const FamilyReport& report) {
  if (!report.without_odd) return nullptr;
  const WithoutOdd& without = *report.without_odd;
  return {{"ids", without.ids},
          {"rmse", RmsePairJson(without.rmse)},
          {"parameters", ValuesJson(report.translation.parameters, without.shared)}};
}

Json CandidatesJson(const FamilyReport& report) {
  Json candidates = Json::array();
  for (const FamilyCandidate& c : report.candidates) {
    candidates.push_back({{"law", ToText(c.law)},
                          {"model", ToText(c.model)},
                          {"rmse", RmsePairJson(c.rmse)},
                          {"held_out_solved_current_A", Number(c.held_out_rmse_A)},
                          {"held_out_median_solved_current_A", Number(c.held_out_median_A)},
                          {"behind_best_standard_errors", Number(c.behind_best)},
                          {"free_parameters", c.free_parameters},
                          {"chosen", c.chosen}});
  }
  return candidates;
}

Json RejectedJson(const FamilyReport& report) {
  Json rejected = Json::array();
  for (const RejectedCurve& curve : report.rejected) {
    rejected.push_back({{"id", curve.id}, {"error", curve.error.ToString()}});
  }
  return rejected;
}

Json CoefficientsJson(const FamilyReport& report) {
  Json coefficients = Json::object();
  for (const Coefficient& c : report.coefficients) {
    coefficients[c.name] = {{"unit", c.unit}, {"interval", IntervalJson(c.value)}};
  }
  return coefficients;
}

// What came out.
void AddAnswer(const FamilyReport& report, Json* json) {
  const TranslationSpec& spec = report.translation.spec;
  const bool shared = !report.estimates.empty();  // else every curve stands on its own
  Json& j = *json;
  j["family"] = shared ? ToText(spec.law) : "free";
  j["model"] = ToText(spec.model);
  j["shunt"] = shared ? Json(ToText(spec.shunt)) : Json(nullptr);
  j["recombination"] = spec.recombination;
  j["cells_in_series"] = report.cells_in_series;
  j["objective"] = ToText(report.objective);
  j["constants"] = ToText(spec.constants);
  j["parameters"] = SharedJson(report);
  j["sensor_offsets"] = {{"irradiance_Wm2", IntervalJson(report.irradiance_offset_W_m2)},
                         {"temperature_K", IntervalJson(report.temperature_offset_K)}};
  j["temperature_coefficients"] = CoefficientsJson(report);
  j["reference"] = shared ? KeyPointsJson(report.reference) : Json(nullptr);
  j["rmse"] = RmseJson(report.rmse);
  j["noise_A"] = Number(report.noise_A);
  j["errors"] = FamilyErrorsJson(report.errors);
}

// How far to trust it.
void AddEvidence(const FamilyReport& report, Json* json) {
  Json& j = *json;
  j["held_out"] = HeldOutJson(report.held_out);
  j["against"] = AgainstJson(report.against);
  j["in_sample"] = HeldOutJson(report.in_sample);
  j["without_odd"] = WithoutOddJson(report);
  j["candidates"] = CandidatesJson(report);
  j["correlations"] = CorrelationsJson(report.correlations);
  j["search"] = SearchJson(report.search_options, report.search, report.search.evaluations);
  j["search"]["curves"] = report.search_ids;
  j["refine"] = {{"termination", report.termination},
                 {"projected_gradient", Number(report.projected_gradient)}};
  j["seconds"] = Number(report.seconds);
  j["free_fits"] = {{"seconds", Number(report.free_seconds)}};
  j["options"] = OptionsJson(report.non_default_options);
  j["rejected"] = RejectedJson(report);
  j["assumptions"] = report.assumptions;
  j["warnings"] = report.warnings;
  j["interrupted"] = report.interrupted;
  j["usable"] = report.usable;
}

}  // namespace

std::string FamilyJson(const FamilyReport& report) {
  Json json;
  json["lyrefit_version"] = report.version;
  json["set"] = {{"name", report.name}, {"source", report.source}};
  if (report.taken != nullptr) {
    const std::optional<Device>& extended = report.translation.extended;
    json["law"] = SetLawJson(report.with, *report.taken,
                             extended && !report.refined.empty() ? &*extended->extension : nullptr);
    json["causes"] = json["law"]["effects"];
  }
  AddAnswer(report, &json);
  AddEvidence(report, &json);
  json["curves"] = CurvesJson(report);
  // Names and files may hold bytes that are not UTF-8.
  return JsonText(json);
}

}  // namespace lyrefit
