#include "lyrefit/report/json_parts.h"

#include "lyrefit/base/constants.h"

namespace lyrefit {

Json CurveJson(const IvCurve& curve) {
  const Conditions& c = curve.conditions;
  // Rounded where the subtraction leaves 33.00000000000006.
  const double temperature_C = std::round((c.cell_temperature_K - kZeroCelsius_K) * 1e9) / 1e9;
  return {{"name", curve.name},
          {"source", curve.source},
          {"points", curve.size()},
          {"conditions",
           {{"cells_in_series", c.cells_in_series},
            {"strings_in_parallel", c.strings_in_parallel},
            {"cell_temperature_C", Number(temperature_C)},
            {"irradiance_Wm2", Number(c.irradiance_W_m2)}}},
          {"assumptions", SentencesOf(curve.assumptions)}};
}

std::string JsonText(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json OptionsJson(const std::vector<OptionEcho>& options) {
  Json list = Json::array();
  for (const OptionEcho& option : options) {
    list.push_back(
        {{"name", option.name}, {"value", option.value}, {"default", option.default_value}});
  }
  return list;
}

}  // namespace lyrefit
