#include "lyrefit/study/report/coverage_json.h"

#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json OptionsOf(const CoverageOptions& options) {
  Json module = nullptr;
  if (!options.module.empty()) {
    module = {{"cells_in_series", options.cells_in_series}};
    for (const auto& [name, value] : options.module) module[name] = Number(value);
  }
  return {{"law", ToText(options.family.law)},
          {"model", ToText(options.family.model)},
          {"sets", options.sets},
          {"seed", options.seed},
          {"curves", options.curves},
          {"points", options.points},
          {"noise_relative", options.noise_relative},
          {"temperature_error_K", options.temperature_error_K},
          {"irradiance_error_W_m2", options.irradiance_error_W_m2},
          {"temperature_offset", options.family.temperature_offset},
          {"irradiance_offset", options.family.irradiance_offset},
          {"module", std::move(module)}};
}

Json ParameterJson(const ParameterCoverage& p) {
  return {{"symbol", p.info.symbol},
          {"name", p.info.name},
          {"fitted", p.fitted},
          {"not_identifiable", p.not_identifiable},
          {"counted", p.counted},
          {"covered", p.covered},
          {"coverage", Number(p.coverage)},
          {"coverage_low_95", Number(p.low_95)},
          {"coverage_high_95", Number(p.high_95)},
          {"median_half_width", Number(p.median_half_width)}};
}

Json SetJson(const CoverageSet& set, const std::vector<ParameterCoverage>& parameters) {
  Json rows = Json::object();
  for (std::size_t i = 0; i < set.rows.size(); ++i) {
    const CoverageRow& row = set.rows[i];
    rows[parameters[i].info.name] = {{"truth", Number(row.truth)},
                                     {"value", Number(row.interval.value)},
                                     {"low_95", Number(row.interval.low_95)},
                                     {"high_95", Number(row.interval.high_95)},
                                     {"fixed", row.fixed},
                                     {"identifiable", row.identifiable}};
  }
  return {{"cells_in_series", set.cells_in_series},
          {"curves", set.curves},
          {"error", set.error.empty() ? Json(nullptr) : Json(set.error)},
          {"parameters", std::move(rows)},
          {"seconds", Number(set.seconds)}};
}

}  // namespace

std::string CoverageJson(const CoverageReport& report) {
  Json parameters = Json::array(), sets = Json::array();
  for (const ParameterCoverage& p : report.parameters) parameters.push_back(ParameterJson(p));
  for (const CoverageSet& set : report.sets) sets.push_back(SetJson(set, report.parameters));
  const Json json = {{"lyrefit_version", report.version},   {"options", OptionsOf(report.options)},
                     {"interrupted", report.interrupted},   {"failed", report.failed},
                     {"parameters", std::move(parameters)}, {"sets", std::move(sets)},
                     {"seconds", Number(report.seconds)}};
  return JsonText(json, 1);
}

}  // namespace lyrefit
