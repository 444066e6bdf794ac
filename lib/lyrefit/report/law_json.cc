#include "lyrefit/report/law_json.h"

namespace lyrefit {
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

Json SetLawJson(const std::vector<EffectUse>& with, const CurveSet& set, const Extension* shared) {
  const IvCurve& first = set.curves.front();
  Json effects = Json::array();
  for (const EffectUse& use : with) effects.push_back(use.effect->id);
  Json law = {
      {"effects", std::move(effects)},
      {"cells_in_series", first.conditions.cells_in_series},
      {"strings_in_parallel", first.conditions.strings_in_parallel},
      {"bypass_diodes", first.notes.bypass_diodes ? Json(*first.notes.bypass_diodes) : Json()}};
  if (shared != nullptr) {
    law["shunt"] = ToText(shared->law.shunt);
    law["bandgap_slope_per_K"] = shared->law.bandgap_slope_per_K;
    law["reference_temperature_C"] = shared->readings.reference_temperature_K - kZeroCelsius_K;
  }
  law["curves"] = Json::array();
  for (const IvCurve& curve : set.curves) law["curves"].push_back(TakenJson(curve));
  return law;
}

}  // namespace lyrefit
