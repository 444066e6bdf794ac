#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string>

#include "lyrefit/curve/key_points.h"
#include "lyrefit/fleet/fleet_task.h"

namespace lyrefit {
namespace {

// Bright light, cold cells and a bright back come to less than twice the rating.
constexpr double kMostOfRating = 3;
// The largest cells give some 20 A.
constexpr double kMostOfString_A = 100;

std::optional<double> RatedPower_W(const FleetCurve& curve) {
  const auto beside = curve.beside.find("rated_power_W");
  if (beside == curve.beside.end()) return std::nullopt;
  double value = 0;
  const char* const end = beside->second.data() + beside->second.size();
  const auto read = std::from_chars(beside->second.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !(value > 0)) return std::nullopt;
  return value;
}

}  // namespace

std::optional<std::string> WhyDoubtful(const FleetCurve& curve) {
  if (!curve.curve) return std::nullopt;
  const KeyPoints key = FindKeyPoints(curve.curve->voltage_V, curve.curve->current_A);
  const std::optional<double> rated_W = RatedPower_W(curve);
  if (rated_W && key.max_power_W > kMostOfRating * *rated_W) {
    return fmt::format(
        "Pmax of {:.4g} W is {:.4g} times the rated power of {:.4g} W beside the curve: other "
        "units "
        "than were read (mA?), or the rating of another device",
        key.max_power_W, key.max_power_W / *rated_W, *rated_W);
  }
  const int strings = curve.curve->conditions.strings_in_parallel;
  if (key.short_circuit_current_A > kMostOfString_A * strings) {
    return fmt::format(
        "Isc of {:.4g} A is more than any cell gives, with {} string{} in parallel: other units "
        "than were read (mA?), or strings in parallel that nobody stated",
        key.short_circuit_current_A, strings, strings == 1 ? "" : "s");
  }
  return std::nullopt;
}

}  // namespace lyrefit
