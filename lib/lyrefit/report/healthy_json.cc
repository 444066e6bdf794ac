#include "lyrefit/report/healthy_json.h"

#include "lyrefit/base/version.h"
#include "lyrefit/report/diagnosis_json.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {
namespace {

Json RowJson(const HealthyRow& row) {
  return {{"symbol", row.symbol},
          {"name", row.name},
          {"unit", row.unit},
          {"now", Number(row.now)},
          {"expected", Number(row.expected)},
          {"low_95", Number(row.low_95)},
          {"high_95", Number(row.high_95)},
          {"z", Number(row.z)},
          {"corrected_p", Number(row.corrected_p)},
          {"power", Number(row.power)},
          {"differs", row.differs}};
}

Json CauseJson(const HealthyCause& cause) {
  return {{"id", cause.id},
          {"sentence", cause.sentence},
          {"size", Number(cause.size)},
          {"low_95", Number(cause.low_95)},
          {"high_95", Number(cause.high_95)},
          {"unit", cause.unit},
          {"power", Number(cause.power)},
          {"explained", Number(cause.explained)}};
}

Json ComparisonJson(const HealthyComparison& comparison) {
  Json rows = Json::array(), causes = Json::array();
  for (const HealthyRow& row : comparison.rows) rows.push_back(RowJson(row));
  for (const HealthyCause& cause : comparison.causes) causes.push_back(CauseJson(cause));
  return {{"name", comparison.name},
          {"differs", comparison.differs},
          {"p_value", Number(comparison.p_value)},
          {"sentence", comparison.sentence},
          {"rows", std::move(rows)},
          {"causes", std::move(causes)},
          {"references", comparison.references},
          {"left_out", comparison.left_out},
          {"regressed_on", comparison.regressed_on},
          {"common", Number(comparison.common)},
          {"warnings", comparison.warnings}};
}

}  // namespace

std::string HealthyJson(const HealthyComparison& comparison, const Diagnosis& diagnosis) {
  Json json;
  json["lyrefit_version"] = Version();
  json["comparison"] = ComparisonJson(comparison);
  json["diagnosis"] = Json::parse(DiagnosisJson(diagnosis));
  return JsonText(json);
}

std::string OddSweepsJson(const OddSweeps& odd) {
  Json sweeps = Json::array();
  for (const HealthyComparison& sweep : odd.sweeps) sweeps.push_back(ComparisonJson(sweep));
  Json json;
  json["lyrefit_version"] = Version();
  json["odd"] = odd.odd;
  json["sweeps"] = std::move(sweeps);
  json["rejected"] = odd.rejected;
  return JsonText(json);
}

}  // namespace lyrefit
