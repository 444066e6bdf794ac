#include "lyrefit/base/version.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json DataSheetParametersJson(const DataSheetFit& fit) {
  Json parameters = Json::object();
  for (int i = 0; i < fit.translation.size(); ++i) {
    const ParameterInfo& info = fit.translation.parameters[i];
    Json one = info;
    one.update({{"value", fit.shared[i]}, {"low", nullptr}, {"high", nullptr}});
    for (const DataSheetRange& range : fit.ranges) {
      if (range.name == info.name) one.update({{"low", range.low}, {"high", range.high}});
    }
    parameters[ParameterKey(info)] = std::move(one);
  }
  return parameters;
}

// A member of the family; an infinite shunt is null.
Json SheetMemberJson(const DataSheetMember& member) {
  return {{"n", member.n},
          {"I_L_ref", member.photocurrent_A},
          {"I_o_ref", member.saturation_current_A},
          {"R_s", member.resistance_series_ohm},
          {"R_sh_ref", member.resistance_shunt_ohm},
          {"beta_oc_V_K", member.beta_oc_V_K},
          {"gamma_pmp_percent_K", member.gamma_pmp_percent_K},
          {"max_power_W", member.max_power_W},
          {"difference_A", member.difference_A}};
}

Json SpreadJson(const MemberSpread& spread) {
  return {{"difference_A", spread.difference_A},
          {"difference_percent", spread.difference_percent},
          {"at_V", spread.at_V},
          {"lowest_power_W", spread.lowest_power_W},
          {"highest_power_W", spread.highest_power_W}};
}

template <class T, class F>
Json WhereKnown(const std::optional<T>& value, const F& write) {
  return value ? write(*value) : Json();
}

Json SheetFamilyJson(const DataSheetFamily& family) {
  const SharpKnee& knee = family.sharp_knee;
  Json conditions = Json::array(), members = Json::array();
  for (const MemberConditions& at : family.conditions) {
    conditions.push_back(
        {{"irradiance_Wm2", at.irradiance_W_m2}, {"temperature_C", at.temperature_C}});
  }
  for (const DataSheetMember& member : family.members) members.push_back(SheetMemberJson(member));
  return {{"bound", family.bound},
          {"sharp_knee",
           {{"I_L_ref", knee.photocurrent_A},
            {"R_s", knee.resistance_series_ohm},
            {"R_sh_ref", knee.resistance_shunt_ohm}}},
          {"conditions", std::move(conditions)},
          {"spread", SpreadJson(family.spread)},
          {"picked", WhereKnown(family.picked, SheetMemberJson)},
          {"rounding",
           {{"low", WhereKnown(family.rounding_low, SheetMemberJson)},
            {"high", WhereKnown(family.rounding_high, SheetMemberJson)},
            {"spread", WhereKnown(family.rounding_spread, SpreadJson)}}},
          {"members", std::move(members)}};
}

}  // namespace

void to_json(Json& j, const DataSheetFit& fit) {
  const TranslationSpec& spec = fit.translation.spec;
  j = {{"lyrefit_version", Version()}, {"law", spec.law},
       {"model", spec.model},          {"cells_in_series", spec.cells_in_series},
       {"constants", spec.constants},  {"parameters", DataSheetParametersJson(fit)},
       {"checks", Json::object()},     {"largest_relative_error", fit.largest_relative_error},
       {"warnings", fit.warnings},     {"family", SheetFamilyJson(fit.family)}};
  for (const DataSheetCheck& check : fit.checks) {
    j["checks"][check.name] = {
        {"unit", check.unit}, {"printed", check.asked}, {"given", check.given}};
  }
}

std::string DataSheetJson(const DataSheetFit& fit) { return Dump(fit); }

}  // namespace lyrefit
