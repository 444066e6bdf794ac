#include <algorithm>

#include "lyrefit/base/constants.h"
#include "lyrefit/devices/device_documents.h"
#include "lyrefit/devices/two_junction_report.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/report/estimate_parts.h"
#include "lyrefit/report/json_parts.h"

namespace lyrefit {

void to_json(Json& j, const StatedLight& light) {
  j = {{"top", light.top}, {"bottom", light.bottom}};
}

void to_json(Json& j, const TwoJunctionCurveReport& one) {
  Json parameters = Json::object();
  const std::vector<ParameterInfo> infos = TwoJunctionInfos();
  for (std::size_t i = 0; i < infos.size(); ++i) parameters[infos[i].name] = one.parameters[i];
  std::vector<double> residual_A(one.model_A.size());
  std::transform(one.model_A.begin(), one.model_A.end(), one.curve.current_A.begin(),
                 residual_A.begin(),
                 [](double model, double measured) { return model - measured; });
  j = {{"id", one.curve.name},
       {"curve", one.curve},
       {"light", one.light},
       {"limiting", one.limiting},
       {"parameters", parameters},
       {"rmse", RmsePair{kUnknown, one.rmse_A}},
       {"key_points", {{"measured", one.measured}, {"simulated", one.simulated}}},
       {"data",
        {{"voltage_V", one.curve.voltage_V},
         {"current_A", one.curve.current_A},
         {"model_current_A", one.model_A},
         {"residual_A", residual_A}}}};
}

std::string TwoJunctionJson(const TwoJunctionReport& report) {
  Json parameters = Json::object();
  for (const Estimate& e : report.estimates) parameters[ParameterKey(e.info)] = e;
  Json j = {{"lyrefit_version", report.version},
            {"name", report.name},
            {"junctions", 2},
            {"objective", ToText(Objective::kSolvedCurrent)},
            {"constants", report.constants},
            {"cell_temperature_C", RoundCelsius(report.temperature_K - kZeroCelsius_K)},
            {"interchangeable", report.interchangeable},
            {"parameters", parameters},
            {"decided_by", report.decided_by},
            {"rmse", {{"searched", report.rmse.searched}, {"refined", report.rmse.refined}}},
            {"curves", report.curves}};
  j.update(CourseJson(report));
  j.update(Json({{"options", report.non_default_options},
                 {"usable", report.usable},
                 {"not_usable_because", report.not_usable_because},
                 {"interrupted", report.interrupted},
                 {"warnings", report.warnings}}));
  return Dump(j);
}

}  // namespace lyrefit
