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
  LYREFIT_PUT_FIELDS(j, notes, tracer, serial, calibration);
  j["operator"] = notes.operated_by;
  j["remark"] = notes.remark;
}

LYREFIT_JSON_FIELDS(CurvePoints, voltage_V, current_A)
LYREFIT_JSON_FIELDS(BudgetEntry, sensitivity, contribution, share)
LYREFIT_JSON_FIELDS(DrawnInterval, mean, standard_deviation, low, high, low_error, high_error,
                    skewness)
LYREFIT_JSON_FIELDS(CheckedCondition, id, title, state, value, limit, unit, found, source, clause,
                    cure)
LYREFIT_JSON_FIELDS(Checklist, conditions, met, not_met, not_known, sentence)

void to_json(Json& j, const UncertainOutput& output) {
  j["name"] = output.quantity.name;
  j["unit"] = output.quantity.unit;
  LYREFIT_PUT_FIELDS(j, output, value, standard_uncertainty, expanded_uncertainty);
  j["low"] = output.low();
  j["high"] = output.high();
  LYREFIT_PUT_FIELDS(j, output, drawn, failed_draws, tolerance, agreement, sentence);
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
  LYREFIT_PUT_FIELDS(j, budget, coverage_factor, coverage_probability, draws, seed);
  j["results"] = budget.outputs;
  j["lines"] = Json::array();
  j["warnings"] = budget.warnings;
  for (const BudgetLine& line : budget.lines) j["lines"].push_back(LineJson(line, budget.outputs));
}

void to_json(Json& j, const FieldTest& test) {
  LYREFIT_PUT_FIELDS(j, test, rated_W, lowest_W, highest_W, tolerance, standard_W, standard_low_W,
                     standard_high_W, zone);
  j["pass"] = IsPass(test.zone);
  LYREFIT_PUT_FIELDS(j, test, doubt, probability_conforms, probability_wrong, probability_step,
                     measured_W, predicted_W, predicted_by, performance_factor, performance_low,
                     performance_high, performance_budget, sentence, notes);
}

void to_json(Json& j, const TranslatedResult& result) {
  LYREFIT_PUT_FIELDS(j, result, procedure, title);
  j["computed"] = result.computed();
  j["why_not"] = result.why_not;
  j["key_points"] = nullptr;
  j["extrapolated"] = result.extrapolated;
  j["budget"] = nullptr;
  j["points"] = nullptr;
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
