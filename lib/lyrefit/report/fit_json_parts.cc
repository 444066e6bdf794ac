#include "lyrefit/report/fit_json_parts.h"

namespace lyrefit {

Json EstimateJson(const Estimate& e, bool polished) {
  const bool at_bound = e.at_bound != BoundSide::kNone;
  return {{"symbol", e.info.symbol},
          {"unit", e.info.unit},
          {"searched", Number(e.searched)},
          {"refined", polished ? Number(e.refined) : Json(nullptr)},
          {"standard_error", Number(e.standard_error)},
          {"low_95", Number(e.low_95)},
          {"high_95", Number(e.high_95)},
          {"interval", ToText(e.interval)},
          {"at_bound", at_bound},
          {"bound_side", at_bound ? Json(ToText(e.at_bound)) : Json(nullptr)},
          {"identifiable", e.identifiable},
          {"reason", e.reason},
          {"fixed", e.fixed},
          {"lower", Number(e.bounds.lower)},
          {"upper", Number(e.bounds.upper)},
          {"whole", e.bounds.whole > 0 ? Json(e.bounds.whole) : Json(nullptr)}};
}

Json ErrorsJson(const std::optional<ErrorReport>& errors) {
  if (!errors) return nullptr;
  return {{"current_noise_A", Number(errors->sizes.current_A)},
          {"voltage_noise_V", Number(errors->sizes.voltage_V)},
          {"path_of_isc", Number(errors->sizes.path)},
          {"sizes", errors->stated ? "stated" : "found"},
          {"current_noise", errors->current_stated ? "stated"
                            : errors->stated       ? "stated"
                                                   : "found"},
          {"gain", Number(errors->gain)},
          {"weighed", errors->weighed},
          {"believed", errors->believed}};
}

Json RmsePairJson(const RmsePair& rmse) {
  return {{"measured_current_A", Number(rmse.measured_current_A)},
          {"solved_current_A", Number(rmse.solved_current_A)}};
}

Json KeyPointsJson(const KeyPoints& points) {
  return {{"short_circuit_current_A", Number(points.short_circuit_current_A)},
          {"open_circuit_voltage_V", Number(points.open_circuit_voltage_V)},
          {"max_power_voltage_V", Number(points.max_power_voltage_V)},
          {"max_power_current_A", Number(points.max_power_current_A)},
          {"max_power_W", Number(points.max_power_W)},
          {"fill_factor", Number(points.fill_factor)}};
}

Json CorrelationsJson(const std::vector<Correlation>& correlations) {
  Json list = Json::array();
  for (const Correlation& c : correlations) {
    list.push_back({{"first", c.first}, {"second", c.second}, {"value", Number(c.value)}});
  }
  return list;
}

Json LargestErrorJson(const ResidualStatistics& r) {
  return {{"current_A", Number(r.largest_A)}, {"voltage_V", Number(r.largest_at_V)}};
}

Json ResidualsJson(const ResidualStatistics& r) {
  return {{"mean_A", Number(r.mean_A)},
          {"runs", r.runs},
          {"expected_runs", Number(r.expected_runs)},
          {"runs_p_value", Number(r.runs_p_value)},
          {"durbin_watson", Number(r.durbin_watson)}};
}

Json SearchJson(const SearchOptions& options, const SearchSummary& search,
                std::int64_t curve_evaluations) {
  Json trace = Json::array();
  for (const TracePoint& point : search.trace) {
    trace.push_back({{"iteration", point.iteration},
                     {"evaluations", point.evaluations},
                     {"best_A", Number(point.best)}});
  }
  return {{"algorithm", ToText(options.algorithm)},
          {"seed", options.seed},
          {"run", options.run},
          {"population", options.population},
          {"iterations", search.iterations},
          {"evaluations", search.evaluations},
          {"curve_evaluations", curve_evaluations},
          {"termination", ToText(search.termination)},
          {"message", search.message},
          {"seconds", Number(search.seconds)},
          {"elites", search.elites.size()},
          {"trace", std::move(trace)}};
}

}  // namespace lyrefit
