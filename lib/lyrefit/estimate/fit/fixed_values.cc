#include "lyrefit/estimate/fit/fixed_values.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/estimate/fit/fit_report.h"

namespace lyrefit {

Expected<std::vector<double>> FixedValues(const std::map<std::string, double>& fixed,
                                          const Device& device) {
  std::vector<double> values(device.size(), kUnknown);
  for (const auto& [key, value] : fixed) {
    bool known = false;
    for (int i = 0; i < device.size(); ++i) {
      const ParameterInfo& info = device.parameters[i];
      const bool group = (key == "Is" && info.kind == ParameterKind::kSaturation) ||
                         (key == "n" && info.kind == ParameterKind::kIdeality);
      if (!group && info.symbol != key && info.name != key) continue;
      const bool must_be_positive =
          info.kind == ParameterKind::kIdeality || info.kind == ParameterKind::kShunt;
      if (!std::isfinite(value) || value < 0 || (must_be_positive && value <= 0)) {
        return Fail(fmt::format("{} cannot be fixed at {:g}, expected a finite number {}", key,
                                value, must_be_positive ? "above 0" : "of 0 or more"));
      }
      values[i] = value;
      known = true;
    }
    if (!known) return Fail(fmt::format("cannot fix '{}': this model has no such parameter", key));
  }
  return values;
}

}  // namespace lyrefit
