#include "lyrefit/study/report/coverage_json.h"

#include "lyrefit/report/json_parts.h"

namespace lyrefit {

void to_json(Json& j, const CoverageOptions& options) {
  Json module = nullptr;
  if (!options.module.empty()) {
    module = {{"cells_in_series", options.cells_in_series}};
    for (const auto& [name, value] : options.module) module[name] = value;
  }
  j = {{"law", options.family.law},
       {"model", options.family.model},
       {"sets", options.sets},
       {"seed", options.seed},
       {"curves", options.curves},
       {"points", options.points},
       {"noise_relative", options.noise_relative},
       {"noise", options.noise},
       {"weights", options.family.weights},
       {"temperature_error_K", options.temperature_error_K},
       {"irradiance_error_W_m2", options.irradiance_error_W_m2},
       {"temperature_offset", options.family.temperature_offset},
       {"irradiance_offset", options.family.irradiance_offset},
       {"module", std::move(module)}};
}

void to_json(Json& j, const ParameterCoverage& p) {
  j = p.info;
  j.update({{"fitted", p.fitted},
            {"not_identifiable", p.not_identifiable},
            {"counted", p.counted},
            {"covered", p.covered},
            {"coverage", p.coverage},
            {"coverage_low_95", p.low_95},
            {"coverage_high_95", p.high_95},
            {"median_half_width", p.median_half_width}});
}

void to_json(Json& j, const CoverageRow& row) {
  j = {{"truth", row.truth},
       {"value", row.interval.value},
       {"low_95", row.interval.low_95},
       {"high_95", row.interval.high_95},
       {"fixed", row.fixed},
       {"identifiable", row.identifiable}};
}

void to_json(Json& j, const CoverageReport& report) {
  Json sets = Json::array();
  for (const CoverageSet& set : report.sets) {
    Json rows = Json::object();
    for (std::size_t i = 0; i < set.rows.size(); ++i) {
      rows[ParameterKey(report.parameters[i].info)] = set.rows[i];
    }
    sets.push_back({{"cells_in_series", set.cells_in_series},
                    {"curves", set.curves},
                    {"error", set.error.empty() ? Json() : Json(set.error)},
                    {"weights", set.weights},
                    {"correlated", set.correlated},
                    {"parameters", std::move(rows)},
                    {"seconds", set.seconds}});
  }
  j = {{"lyrefit_version", report.version}, {"options", report.options},
       {"interrupted", report.interrupted}, {"failed", report.failed},
       {"relative", report.relative},       {"correlated", report.correlated},
       {"parameters", report.parameters},   {"sets", std::move(sets)},
       {"seconds", report.seconds}};
}

std::string CoverageJson(const CoverageReport& report) { return Dump(report); }

}  // namespace lyrefit
