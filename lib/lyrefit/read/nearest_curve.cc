#include "lyrefit/read/nearest_curve.h"

#include <fmt/format.h>

#include <cmath>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {
namespace {

// Spans of an outdoor record, so that neither quantity dominates. With a smaller span of
// temperature, a set without cold curves at low irradiance would return 400 W/m2 for 200.
constexpr double kIrradianceUnit_W_m2 = 1000;
constexpr double kTemperatureUnit_K = 100;

}  // namespace

Expected<std::size_t> NearestCurve(const CurveSet& set, double irradiance_W_m2,
                                   double temperature_C) {
  if (!(irradiance_W_m2 >= 0) || !std::isfinite(irradiance_W_m2) ||
      !(temperature_C > -kZeroCelsius_K) || !std::isfinite(temperature_C)) {
    return Fail(
        fmt::format("expected an irradiance from 0 W/m2 up and a temperature, found {:g} "
                    "W/m2 and {:g} C",
                    irradiance_W_m2, temperature_C));
  }
  std::size_t nearest = set.curves.size();
  double smallest = kInfinity;
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    const IvCurve& curve = set.curves[i];
    if (!curve.irradiance_known || !curve.temperature_known) continue;
    const double distance =
        std::hypot((curve.conditions.irradiance_W_m2 - irradiance_W_m2) / kIrradianceUnit_W_m2,
                   (curve.conditions.cell_temperature_K - kZeroCelsius_K - temperature_C) /
                       kTemperatureUnit_K);
    if (distance < smallest) {
      smallest = distance;
      nearest = i;
    }
  }
  if (nearest == set.curves.size()) {
    return Fail("no curve of the set has a known irradiance and temperature to choose it by",
                set.source);
  }
  return nearest;
}

Expected<std::size_t> FindCurve(const CurveSet& set, const std::string& id) {
  for (std::size_t i = 0; i < set.curves.size(); ++i) {
    if (set.curves[i].name == id) return i;
  }
  constexpr std::size_t kShown = 5;
  std::string ids;
  for (std::size_t i = 0; i < set.curves.size() && i < kShown; ++i) {
    ids += (i > 0 ? ", " : "") + set.curves[i].name;
  }
  if (set.curves.size() > kShown) ids += ", ...";
  return Fail(
      fmt::format("there is no curve {}: the {} curves are {}", Quoted(id), set.curves.size(), ids),
      set.source);
}

std::string ConditionsText(const IvCurve& curve) {
  const Conditions& c = curve.conditions;
  const std::string irradiance =
      curve.irradiance_known ? fmt::format("{:.5g}", c.irradiance_W_m2) : "?";
  const std::string temperature =
      curve.temperature_known ? fmt::format("{:.3g}", c.cell_temperature_K - kZeroCelsius_K) : "?";
  return irradiance + " W/m2, " + temperature + " C";
}

std::string LabelInSet(const CurveSet& set, const IvCurve& curve) {
  return fmt::format("{}/{} ({})", set.name, curve.name, ConditionsText(curve));
}

}  // namespace lyrefit
