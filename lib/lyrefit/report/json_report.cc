#include "lyrefit/report/json_report.h"

#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json ParametersJson(const FitReport& report) {
  Json parameters = Json::object();
  for (const Estimate& e : report.estimates) {
    const bool at_bound = e.at_bound != BoundSide::kNone;
    parameters[e.info.name] = {{"symbol", e.info.symbol},
                               {"unit", e.info.unit},
                               {"searched", Number(e.searched)},
                               {"refined", report.polished ? Number(e.refined) : Json(nullptr)},
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
                               {"upper", Number(e.bounds.upper)}};
  }
  return parameters;
}

// Null for the models that pvlib's function does not know.
Json SingleDiodeJson(const FitReport& report) {
  if (report.model != Model::kSingleDiode || report.refined.size() != 5) return nullptr;
  return {{"photocurrent", Number(report.refined[kIph])},
          {"saturation_current", Number(report.refined[SaturationCurrentIndex(0)])},
          {"resistance_series", Number(report.refined[kRs])},
          {"resistance_shunt", Number(report.refined[kRsh])},
          {"nNsVth", Number(report.nNsVth)}};
}

Json RmseJson(const FitReport& report) {
  const auto pair = [](const RmsePair& rmse, bool known) {
    const RmsePair shown = known ? rmse : RmsePair{};
    return Json{{"measured_current_A", Number(shown.measured_current_A)},
                {"solved_current_A", Number(shown.solved_current_A)}};
  };
  return {{"random_baseline", pair(report.rmse.random_baseline, true)},
          {"searched", pair(report.rmse.searched, true)},
          {"plain_polished", pair(report.rmse.plain_polished, true)},
          {"best_bird_polished", pair(report.rmse.best_bird_polished, report.polished)},
          {"refined", pair(report.rmse.refined, report.polished)}};
}

// Null where it was not asked for.
Json FloorJson(const FitReport& report) {
  if (!report.floor) return nullptr;
  const FloorReport& floor = *report.floor;
  return {{"measured_current_rmse_A", Number(floor.rmse_A)},
          {"lower_bound_A", Number(floor.lower_bound_A)},
          {"n_lower", Number(floor.n_lower)},
          {"n_upper", Number(floor.n_upper)},
          {"refined_above", Number(floor.above)}};
}

Json KeyPointsJson(const KeyPoints& k) {
  return {{"short_circuit_current_A", Number(k.short_circuit_current_A)},
          {"open_circuit_voltage_V", Number(k.open_circuit_voltage_V)},
          {"max_power_voltage_V", Number(k.max_power_voltage_V)},
          {"max_power_current_A", Number(k.max_power_current_A)},
          {"max_power_W", Number(k.max_power_W)},
          {"fill_factor", Number(k.fill_factor)}};
}

Json ResidualsJson(const ResidualStatistics& r) {
  return {{"mean_A", Number(r.mean_A)},
          {"runs", r.runs},
          {"expected_runs", Number(r.expected_runs)},
          {"runs_p_value", Number(r.runs_p_value)},
          {"durbin_watson", Number(r.durbin_watson)}};
}

Json CorrelationsJson(const std::vector<Correlation>& correlations) {
  Json list = Json::array();
  for (const Correlation& c : correlations) {
    list.push_back({{"first", c.first}, {"second", c.second}, {"value", Number(c.value)}});
  }
  return list;
}

Json SearchJson(const FitReport& report) {
  const SearchOptions& options = report.search_options;
  const SearchSummary& search = report.search;
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
          {"termination", ToText(search.termination)},
          {"message", search.message},
          {"seconds", Number(search.seconds)},
          {"elites", search.elites.size()},
          {"trace", std::move(trace)}};
}

Json RefineJson(const RefineReport& refine) {
  Json starts = Json::array();
  for (const StartReport& start : refine.starts) {
    starts.push_back({{"origin", start.origin},
                      {"start_rmse_A", Number(start.start_rmse_A)},
                      {"end_rmse_A", Number(start.end_rmse_A)},
                      {"agrees", start.agrees}});
  }
  return {{"termination", refine.termination},
          {"message", refine.message},
          {"starts", refine.starts.size()},
          {"agreeing", refine.agreeing},
          {"winner", refine.winner < 0 ? Json(nullptr) : Json(refine.winner)},
          {"projected_gradient", Number(refine.projected_gradient)},
          {"condition", Number(refine.condition)},
          {"seconds", Number(refine.seconds)},
          {"start_list", std::move(starts)}};
}

Json ChoiceJson(const std::optional<ModelChoice>& choice) {
  if (!choice) return nullptr;
  Json candidates = Json::array();
  for (const CandidateReport& c : choice->candidates) {
    candidates.push_back({{"model", ToText(c.model)},
                          {"rmse_A", Number(c.rmse_A)},
                          {"held_out_rmse_A", Number(c.held_out_rmse_A)},
                          {"aicc", Number(c.aicc)},
                          {"f_p_value", Number(c.f_p_value)},
                          {"identifiable", c.identifiable}});
  }
  return {{"chosen", ToText(choice->chosen)},
          {"sentence", choice->sentence},
          {"candidates", std::move(candidates)}};
}

// What came out.
void AddAnswer(const FitReport& report, Json* json) {
  Json& j = *json;
  j["parameters"] = ParametersJson(report);
  j["nNsVth"] = Number(report.nNsVth);
  j["singlediode"] = SingleDiodeJson(report);
  j["rmse"] = RmseJson(report);
  j["floor"] = FloorJson(report);
  j["largest_error"] = {{"current_A", Number(report.residuals.largest_A)},
                        {"voltage_V", Number(report.residuals.largest_at_V)}};
  j["key_points"] = {{"measured", KeyPointsJson(report.measured)},
                     {"simulated", KeyPointsJson(report.simulated)}};
}

// How it was found and how far to trust it.
void AddEvidence(const FitReport& report, Json* json) {
  Json& j = *json;
  j["information"] = {{"points", report.criteria.points},
                      {"parameters", report.criteria.parameters},
                      {"aicc", Number(report.criteria.aicc)},
                      {"bic", Number(report.criteria.bic)}};
  j["residuals"] = ResidualsJson(report.residuals);
  j["correlations"] = CorrelationsJson(report.correlations);
  j["search"] = SearchJson(report);
  j["refine"] = RefineJson(report.refine);
  j["intervals"] = {{"seconds", Number(report.interval_seconds)}};
  j["model_choice"] = ChoiceJson(report.choice);
  j["options"] = OptionsJson(report.non_default_options);
  j["interrupted"] = report.interrupted;
  j["usable"] = report.usable;
  j["warnings"] = report.warnings;
}

}  // namespace

std::string JsonReport(const FitReport& report) {
  Json json;
  json["lyrefit_version"] = report.version;
  json["curve"] = CurveJson(report.curve);
  json["model"] = ToText(report.model);
  json["objective"] = ToText(report.objective);
  json["constants"] = ToText(report.constants);
  json["bounds"] = report.bounds_name;
  AddAnswer(report, &json);
  AddEvidence(report, &json);
  json["data"] = {{"voltage_V", Numbers(report.curve.voltage_V)},
                  {"current_A", Numbers(report.curve.current_A)},
                  {"model_current_A", Numbers(report.model_current_A)},
                  {"residual_A", Numbers(report.residual_A)}};
  // Names and files may hold bytes that are not UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lyrefit
