#include "lyrefit/report/json.h"

#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/curve_kind.h"
#include "lyrefit/report/fit_parts.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

double RoundCelsius(double celsius) { return std::round(celsius * 1e9) / 1e9; }

// Keys of the conditions that were not stated.
static Json AssumedJson(const IvCurve& curve) {
  Json keys = Json::array();
  if (!curve.cells_known) keys.push_back("cells_in_series");
  if (!curve.strings_known) keys.push_back("strings_in_parallel");
  if (!curve.temperature_known) keys.push_back("cell_temperature_C");
  if (!curve.irradiance_known) keys.push_back("irradiance_Wm2");
  return keys;
}

void to_json(Json& j, const IvCurve& curve) {
  const Conditions& c = curve.conditions;
  j = {{"name", curve.name},
       {"source", curve.source},
       {"points", curve.size()},
       {"kind", curve.size() > 0 ? ToText(KindOf(curve).kind) : ""},
       {"conditions",
        {{"cells_in_series", c.cells_in_series},
         {"strings_in_parallel", c.strings_in_parallel},
         {"cell_temperature_C", RoundCelsius(c.cell_temperature_K - kZeroCelsius_K)},
         {"irradiance_Wm2", c.irradiance_W_m2}}},
       {"assumed", AssumedJson(curve)},
       {"assumptions", SentencesOf(curve.assumptions)}};
}

void to_json(Json& j, const OptionEcho& option) {
  j = {{"name", option.name}, {"value", option.value}, {"default", option.default_value}};
}

Json EffectParameterJson(const std::string& effect, const std::string& symbol,
                         const std::string& name, const std::string& unit) {
  return {{"effect", effect}, {"symbol", symbol}, {"name", name}, {"unit", unit}};
}

// Symbol and name of an effect's parameter have the effect as prefix (see AddInfos).
void to_json(Json& j, const ParameterInfo& info) {
  const std::size_t dot = info.symbol.find('.');
  if (dot == std::string::npos) {
    j = {{"symbol", info.symbol}, {"name", info.name}, {"unit", info.unit}};
    return;
  }
  const std::string effect = info.symbol.substr(0, dot);
  const bool prefixed = info.name.rfind(effect + "_", 0) == 0;
  j = EffectParameterJson(effect, info.symbol.substr(dot + 1),
                          prefixed ? info.name.substr(dot + 1) : info.name, info.unit);
}

void to_json(Json& j, const Estimate& e) {
  const bool at_bound = e.at_bound != BoundSide::kNone;
  j = e.info;
  j.update({{"searched", e.searched},
            {"refined", e.refined},
            {"standard_error", e.standard_error},
            {"low_95", e.low_95},
            {"high_95", e.high_95},
            {"interval", e.interval},
            {"at_bound", at_bound},
            {"bound_side", at_bound ? Json(e.at_bound) : Json()},
            {"identifiable", e.identifiable},
            {"reason", e.reason},
            {"fixed", e.fixed},
            {"lower", e.bounds.lower},
            {"upper", e.bounds.upper},
            {"whole", e.bounds.whole > 0 ? Json(e.bounds.whole) : Json()}});
}

LYREFIT_JSON_FIELDS(Ranged, value, low_95, high_95)
LYREFIT_JSON_FIELDS(RmsePair, measured_current_A, solved_current_A)
LYREFIT_JSON_FIELDS(KeyPoints, short_circuit_current_A, open_circuit_voltage_V, max_power_voltage_V,
                    max_power_current_A, max_power_W, fill_factor)
LYREFIT_JSON_FIELDS(Correlation, first, second, value)
LYREFIT_JSON_FIELDS(ResidualStatistics, mean_A, runs, expected_runs, runs_p_value, durbin_watson)

Json LargestErrorJson(const ResidualStatistics& residuals) {
  return {{"current_A", residuals.largest_A}, {"voltage_V", residuals.largest_at_V}};
}

void to_json(Json& j, const ErrorReport& errors) {
  const auto origin = [](bool stated) { return stated ? "stated" : "found"; };
  j = {{"current_noise_A", errors.sizes.current_A},
       {"voltage_noise_V", errors.sizes.voltage_V},
       {"path_of_isc", errors.sizes.path},
       {"path_length_of_voc", errors.sizes.length},
       {"sizes", origin(errors.stated)},
       {"current_noise", origin(errors.current_stated || errors.stated)},
       {"current_noise_part", errors.sizes.current_part},
       {"gain", errors.gain},
       {"path_gain", errors.path_gain},
       {"kind", errors.Taken()},
       {"weighed", errors.weighed},
       {"believed", errors.believed}};
}

void to_json(Json& j, const TracePoint& point) {
  j = {{"iteration", point.iteration}, {"evaluations", point.evaluations}, {"best_A", point.best}};
}

Json SearchJson(const SearchOptions& options, const SearchSummary& search,
                std::int64_t curve_evaluations) {
  return {{"algorithm", options.algorithm},
          {"seed", options.seed},
          {"run", options.run},
          {"population", options.population},
          {"iterations", search.iterations},
          {"evaluations", search.evaluations},
          {"curve_evaluations", curve_evaluations},
          {"termination", search.termination},
          {"message", search.message},
          {"seconds", search.seconds},
          {"elites", search.elites.size()},
          {"trace", search.trace}};
}

namespace {

Json TakenJson(const IvCurve& curve) {
  const Conditions& at = curve.conditions;
  Json json = {{"id", curve.name},
               {"irradiance_Wm2", at.irradiance_W_m2},
               {"cell_temperature_C", at.cell_temperature_K - kZeroCelsius_K},
               {"voltage_V", curve.voltage_V},
               {"current_A", curve.current_A}};
  if (!curve.time_s.empty()) json["time_s"] = curve.time_s;
  if (!curve.irradiance_W_m2.empty()) json["reading_irradiance_Wm2"] = curve.irradiance_W_m2;
  return json;
}

}  // namespace

Json SetLawJson(const std::vector<EffectUse>& with, const CurveSet& set,
                const DeviceEffects* shared) {
  const IvCurve& first = set.curves.front();
  Json effects = Json::array();
  for (const EffectUse& use : with) effects.push_back(use.effect->id);
  Json law = {{"effects", std::move(effects)},
              {"cells_in_series", first.conditions.cells_in_series},
              {"strings_in_parallel", first.conditions.strings_in_parallel},
              {"bypass_diodes", first.notes.bypass_diodes}};
  if (shared != nullptr) {
    law["shunt"] = shared->law.shunt;
    law["bandgap_slope_per_K"] = shared->law.bandgap_slope_per_K;
    law["reference_temperature_C"] = shared->readings.reference_temperature_K - kZeroCelsius_K;
  }
  law["curves"] = Json::array();
  for (const IvCurve& curve : set.curves) law["curves"].push_back(TakenJson(curve));
  return law;
}

LYREFIT_JSON_FIELDS(StartReport, origin, start_rmse_A, end_rmse_A, agrees)
LYREFIT_JSON_FIELDS(OptimumCount::Independent, ends, local_optima, best_visits, once, twice)
LYREFIT_JSON_FIELDS(OptimumCount, ends, local_optima, best_visits, independent, unseen)
LYREFIT_JSON_FIELDS(CandidateReport, model, rmse_A, held_out_rmse_A, aicc, f_p_value, identifiable)
LYREFIT_JSON_FIELDS(ModelChoice, chosen, sentence, candidates)
LYREFIT_JSON_FIELDS(InformationCriteria, points, parameters, aicc, bic)

void to_json(Json& j, const FloorReport& floor) {
  j["objective"] = ToText(floor.objective);
  LYREFIT_PUT_FIELDS(j, floor, rmse_A, lower_bound_A, gap, n_lower, n_upper);
  j["refined_above"] = floor.above;
  j["minimised"] = floor.minimised;
}

void to_json(Json& j, const RefineReport& refine) {
  LYREFIT_PUT_FIELDS(j, refine, termination, message);
  j["starts"] = refine.starts.size();
  j["agreeing"] = refine.agreeing;
  j["winner"] = refine.winner < 0 ? Json() : Json(refine.winner);
  LYREFIT_PUT_FIELDS(j, refine, projected_gradient, condition, seconds, local_optima);
  j["start_list"] = refine.starts;
}

void to_json(Json& j, const VariantReport& variant) {
  LYREFIT_PUT_FIELDS(j, variant, what, free);
  j["solved_current_rmse_A"] = variant.rmse_A;
  LYREFIT_PUT_FIELDS(j, variant, bic_above, finished, chosen);
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
