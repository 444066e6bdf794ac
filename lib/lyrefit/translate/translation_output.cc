#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/report/csv.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/translate/key_point_noise.h"
#include "lyrefit/translate/translation_documents.h"
#include "lyrefit/translate/translation_report.h"

namespace lyrefit {

void to_json(Json& j, const TranslationInputs& inputs) {
  j = Json::object();
  for (const TranslationInput& input : kTranslationInputs) j[input.name] = inputs.*input.field;
}

LYREFIT_JSON_FIELDS(TranslationTarget, irradiance_W_m2, temperature_C)
void to_json(Json& j, const FieldNotes& notes) {
  j = {{"tracer", notes.tracer},
       {"serial", notes.serial},
       {"calibration", notes.calibration},
       {"operator", notes.operated_by},
       {"remark", notes.remark}};
}

LYREFIT_JSON_FIELDS(CurvePoints, voltage_V, current_A)
LYREFIT_JSON_FIELDS(BudgetEntry, sensitivity, contribution, share)
LYREFIT_JSON_FIELDS(DrawnInterval, mean, standard_deviation, low, high, low_error, high_error,
                    skewness)
LYREFIT_JSON_FIELDS(CheckedCondition, id, title, state, value, limit, unit, found, source, clause,
                    cure)
LYREFIT_JSON_FIELDS(Checklist, conditions, met, not_met, not_known, sentence)

void to_json(Json& j, const UncertainOutput& output) {
  j = {{"name", output.quantity.name},
       {"unit", output.quantity.unit},
       {"value", output.value},
       {"standard_uncertainty", output.standard_uncertainty},
       {"expanded_uncertainty", output.expanded_uncertainty},
       {"low", output.low()},
       {"high", output.high()},
       {"drawn", output.drawn},
       {"failed_draws", output.failed_draws},
       {"tolerance", output.tolerance},
       {"agreement", output.agreement},
       {"sentence", output.sentence}};
}

namespace {

Json LineJson(const BudgetLine& line, const std::vector<UncertainOutput>& outputs) {
  Json json = {{"name", line.name},
               {"title", line.title},
               {"group", line.group},
               {"unit", line.unit},
               {"value", line.value},
               {"standard_uncertainty", line.standard_uncertainty},
               {"distribution", line.distribution},
               {"source", line.source},
               {"of", Json::object()}};
  for (std::size_t k = 0; k < line.entries.size() && k < outputs.size(); ++k) {
    json["of"][outputs[k].quantity.name] = line.entries[k];
  }
  return json;
}

}  // namespace

void to_json(Json& j, const UncertaintyBudget& budget) {
  j = {{"coverage_factor", budget.coverage_factor},
       {"coverage_probability", budget.coverage_probability},
       {"draws", budget.draws},
       {"seed", budget.seed},
       {"results", budget.outputs},
       {"lines", Json::array()},
       {"warnings", budget.warnings}};
  for (const BudgetLine& line : budget.lines) j["lines"].push_back(LineJson(line, budget.outputs));
}

void to_json(Json& j, const FieldTest& test) {
  j = {{"rated_W", test.rated_W},
       {"lowest_W", test.lowest_W},
       {"highest_W", test.highest_W},
       {"tolerance", test.tolerance},
       {"standard_W", test.standard_W},
       {"standard_low_W", test.standard_low_W},
       {"standard_high_W", test.standard_high_W},
       {"zone", test.zone},
       {"pass", IsPass(test.zone)},
       {"doubt", test.doubt},
       {"probability_conforms", test.probability_conforms},
       {"probability_wrong", test.probability_wrong},
       {"probability_step", test.probability_step},
       {"measured_W", test.measured_W},
       {"predicted_W", test.predicted_W},
       {"predicted_by", test.predicted_by},
       {"performance_factor", test.performance_factor},
       {"performance_low", test.performance_low},
       {"performance_high", test.performance_high},
       {"performance_budget", test.performance_budget},
       {"sentence", test.sentence},
       {"notes", test.notes}};
}

void to_json(Json& j, const TranslatedResult& result) {
  j = {{"procedure", result.procedure},
       {"title", result.title},
       {"computed", result.computed()},
       {"why_not", result.why_not},
       {"key_points", nullptr},
       {"extrapolated", result.extrapolated},
       {"budget", nullptr},
       {"points", nullptr}};
  if (!result.computed()) return;
  j["key_points"] = result.key_points;
  if (!result.budget.outputs.empty()) j["budget"] = result.budget;
  j["points"] = result.curve;
}

void to_json(Json& j, const TranslationReport& report) {
  const TranslatedResult* best = report.Recommended();
  j = {{"lyrefit_version", report.version},
       {"curve", report.curve},
       {"target", report.target},
       {"key_point_method", report.method},
       {"equivalent_irradiance_Wm2", report.equivalent_irradiance_W_m2},
       {"measured", report.source},
       {"recommended", best == nullptr ? Json() : Json(best->procedure)},
       {"reason", report.reason},
       {"field_test", report.field_test},
       {"results", report.results},
       {"inputs", report.inputs.values},
       {"read_temperature_C", report.read_temperature_C},
       {"cell_correction_K", report.inputs.cell_correction_K},
       {"notes", report.notes},
       {"verdict", report.verdict},
       {"causes", report.causes},
       {"causes_kept", report.kept},
       {"causes_removed", report.removed},
       {"checklist", report.checklist},
       {"non_default_options", report.non_default_options},
       {"assumptions", report.assumptions},
       {"warnings", report.warnings},
       {"seed", report.seed},
       {"interrupted", report.interrupted},
       {"seconds", report.seconds}};
}

std::string TranslationJson(const TranslationReport& report) { return Dump(report); }

std::string TranslationCsv(const TranslationReport& report) {
  std::string text =
      "curve,irradiance_Wm2,temperature_C,procedure,recommended,isc_A,isc_A_U,voc_V,voc_V_U,imp_A,"
      "imp_A_U,vmp_V,vmp_V_U,pmax_W,pmax_W_U,fill_factor,fill_factor_U,why_not\n";
  for (std::size_t i = 0; i < report.results.size(); ++i) {
    const TranslatedResult& result = report.results[i];
    std::vector<std::string> fields = {
        CsvField(report.curve.name), CsvField(report.target.irradiance_W_m2),
        CsvField(report.target.temperature_C), ToText(result.procedure),
        static_cast<int>(i) == report.recommended ? "yes" : "no"};
    const std::vector<double> values = KeyPointVector(result.key_points);
    for (std::size_t k = 0; k < values.size(); ++k) {
      const bool known = k < result.budget.outputs.size();
      fields.push_back(CsvField(result.computed() ? values[k] : kUnknown));
      fields.push_back(CsvField(known ? result.budget.outputs[k].expanded_uncertainty : kUnknown));
    }
    fields.push_back(CsvField(result.why_not));
    text += CsvLine(fields);
  }
  return text;
}

}  // namespace lyrefit
