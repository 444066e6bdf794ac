#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "trend/years_year.h"

namespace years {
namespace {

using Json = nlohmann::ordered_json;

void Append(const char* format, double value, std::string* text) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, format, value);
  *text += buffer;
}

void AppendList(const char* format, const std::vector<double>& values, std::string* text) {
  const char* blank = "";
  for (const double value : values) {
    *text += blank;
    Append(format, value, text);
    blank = " ";
  }
}

double Rounded(double value) {  // to six digits, so that records stay short
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return std::strtod(buffer, nullptr);
}

Json Percent(const Split& split) {
  Json json = {{"total", Rounded(100 * split.Total() / split.undamaged)}};
  for (int k = 0; k < kParts; ++k) {
    json[kPartNames[k]] = Rounded(100 * split.lost[k] / split.undamaged);
  }
  return json;
}

Json DailyJson(const ModuleYear& year) {
  Json dates = Json::array(), undamaged = Json::array(), light = Json::array();
  Json standard = Json::array(), parts = Json::object();
  for (const char* name : kPartNames) parts[name] = Json::array();
  for (std::size_t d = 0; d < year.daily.size(); ++d) {
    const Daily& day = year.daily[d];
    dates.push_back(DateOf(static_cast<int>(d)));
    undamaged.push_back(Rounded(day.energy.undamaged));
    for (int k = 0; k < kParts; ++k) parts[kPartNames[k]].push_back(Rounded(day.energy.lost[k]));
    light.push_back(Rounded(day.state.light));
    standard.push_back(Rounded(day.standard.power()));
  }
  return {{"date", dates},
          {"undamaged_Wh", undamaged},
          {"lost_Wh", parts},
          {"light", light},
          {"p_mp_W", standard}};
}

// A quantity at standard conditions. Its rate is of the steady change; it has none while
// potential-induced damage grows.
Json Quantity(const char* name, const char* unit, double at_start, double percent_per_year,
              bool steady) {
  Json json = {{"name", name}, {"unit", unit}, {"at_start", Rounded(at_start)}};
  json["rate_per_year"] = steady ? Json(Rounded(at_start * percent_per_year / 100)) : Json(nullptr);
  json["rate_percent_per_year"] = steady ? Json(Rounded(percent_per_year)) : Json(nullptr);
  json["steps"] = Json::array();
  return json;
}

Json QuantitiesJson(const ModuleYear& year) {
  const Effects& effects = year.effects;
  const bool pid = effects.pid_day >= 0;
  Json series = Quantity("resistance_series", "ohm", SeriesOhm(year.design), effects.series, true);
  if (effects.step_day >= 0) {
    series["steps"].push_back(
        {{"date", DateOf(effects.step_day)}, {"size", Rounded(effects.step_ohm)}});
  }
  const bool clean = effects.soiling == 0 && !effects.snow;
  return {series, Quantity("resistance_shunt", "ohm", ShuntOhm(year.design), 0, !pid),
          Quantity("recombination", "A", Recombination_A(year.design), effects.recombination, !pid),
          Quantity("light", "1", 1, 0, clean)};
}

Json OnsetsJson(const Effects& effects) {
  Json onsets = Json::array();
  const auto add = [&](int day, const char* cause, const Json& quantities) {
    if (day < 0) return;
    onsets.push_back({{"date", DateOf(day)}, {"cause", cause}, {"quantities", quantities}});
  };
  add(effects.bypass_day, "bypass_short", {"mismatch"});
  add(effects.step_day, "series_step", {"resistance_series"});
  add(effects.pid_day, "pid", {"resistance_shunt", "recombination"});
  return onsets;
}

// Quantities that truly change over time: claims about them are not false alarms.
Json VariesJson(const Effects& effects) {
  Json varies = Json::array();
  if (effects.soiling > 0 || effects.snow) varies.push_back("light");
  if (effects.snow || effects.bypass_day >= 0) varies.push_back("mismatch");
  if (effects.series != 0 || effects.step_day >= 0) varies.push_back("resistance_series");
  if (effects.recombination > 0 || effects.pid_day >= 0) varies.push_back("recombination");
  if (effects.pid_day >= 0) varies.push_back("resistance_shunt");
  return varies;
}

Json EffectsJson(const Effects& effects) {
  Json json = Json::object();
  if (effects.soiling > 0) {
    json["soiling_percent_per_day"] = Rounded(effects.soiling);
    json["washed"] = Rounded(effects.washed);
  }
  if (effects.snow) json["snow"] = true;
  if (effects.bypass_day >= 0) json["bypass_short"] = DateOf(effects.bypass_day);
  if (effects.series != 0) json["series_percent_per_year"] = Rounded(effects.series);
  if (effects.step_day >= 0) json["series_step_ohm"] = Rounded(effects.step_ohm);
  if (effects.pid_day >= 0) {
    json["pid"] = {{"date", DateOf(effects.pid_day)},
                   {"days", Rounded(effects.pid_days)},
                   {"shunt_factor", Rounded(effects.pid_shunt)},
                   {"recombination_factor", Rounded(effects.pid_recombination)}};
  }
  if (effects.recombination > 0) {
    json["recombination_percent_per_year"] = Rounded(effects.recombination);
  }
  return json;
}

Json InstrumentsJson(const Instruments& instruments) {
  return {{"light_gain", Rounded(instruments.light_gain)},
          {"light_drift_percent_per_year", Rounded(100 * instruments.light_drift)},
          {"light_offset_Wm2", Rounded(instruments.light_offset_Wm2)},
          {"light_cosine", Rounded(instruments.light_cosine)},
          {"temperature_offset_K", Rounded(instruments.kelvin_offset)},
          {"cells_above_back_K", Rounded(instruments.kelvin_gap)},
          {"current_gain", Rounded(instruments.current_gain)},
          {"voltage_gain", Rounded(instruments.voltage_gain)},
          {"noise", instruments.noise}};
}

}  // namespace

std::string SweepsCsv(const ModuleYear& year) {
  std::string text =
      "date,irradiance_Wm2,temperature_C,cells_in_series,bypass_diodes,voltage_V,current_A\n";
  const std::string module = "," + std::to_string(kCells) + "," + std::to_string(kGroups) + ",";
  for (const Row& row : year.rows) {
    text += row.date;
    Append(",%.1f", row.shown.irradiance_Wm2, &text);
    Append(",%.2f", row.shown.temperature_C, &text);
    text += module;
    AppendList("%.3f", row.sweep.voltage, &text);
    text += ',';
    AppendList("%.4f", row.sweep.current, &text);
    text += '\n';
  }
  return text;
}

std::string OperatingCsv(const ModuleYear& year) {
  std::string text = "date,irradiance_Wm2,temperature_C,vmp_V,imp_A\n";
  for (const Row& row : year.rows) {
    text += row.date;
    Append(",%.1f", row.shown.irradiance_Wm2, &text);
    Append(",%.2f", row.shown.temperature_C, &text);
    Append(",%.3f", row.held.at.voltage, &text);
    Append(",%.4f\n", row.held.at.current, &text);
  }
  return text;
}

std::string TruthJson(const Request& request, const ModuleYear& year) {
  LitModule module(year.design, State{}, 1, 298.15);
  const Operating maximum = module.MaximumPower();
  Json gaps = Json::array();
  for (const Gap& gap : year.gaps) gaps.push_back({DateOf(gap.first), DateOf(gap.last)});
  Json json = {{"seed", request.seed},
               {"start", DateOf(0)},
               {"end", DateOf(request.days - 1)},
               {"minutes", request.minutes},
               {"rows", year.rows.size()},
               {"bad_rows", year.bad},
               {"empty_rows", year.missing},
               {"gaps", gaps}};
  json["module"] = {
      {"i_sc_A", Rounded(module.ShortCircuit())},
      {"v_oc_V", Rounded(module.OpenCircuit())},
      {"i_mp_A", Rounded(maximum.current)},
      {"v_mp_V", Rounded(maximum.voltage)},
      {"p_mp_W", Rounded(maximum.power())},
      {"resistance_series_percent_per_K", Rounded(100 * year.design.series_per_kelvin)}};
  json["effects"] = EffectsJson(year.effects);
  json["quantities"] = QuantitiesJson(year);
  json["onsets"] = OnsetsJson(year.effects);
  json["varies"] = VariesJson(year.effects);
  json["loss"] = {{"split", "Shapley"},
                  {"undamaged_kWh", Rounded(year.recorded.undamaged / 1000)},
                  {"energy_percent", Percent(year.recorded)},
                  {"energy_percent_with_gaps", Percent(year.whole)}};
  json["operating"] = {
      {"tracking", year.modes[0]},
      {"failing", year.modes[1]},
      {"clipped", year.modes[2]},
      {"curtailed", year.modes[3]},
      {"limit_W",
       year.inverter.limit_W < 1e9 ? Json(Rounded(year.inverter.limit_W)) : Json(nullptr)}};
  json["instruments"] = InstrumentsJson(year.instruments);
  json["daily"] = DailyJson(year);
  return json.dump() + "\n";
}

}  // namespace years
