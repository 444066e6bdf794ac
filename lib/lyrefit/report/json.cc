#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/curve_kind.h"
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

}  // namespace lyrefit
