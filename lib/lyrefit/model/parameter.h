#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Scale on which a search spaces its steps over a parameter's range.
enum class SearchScale {
  kLinear,
  kLog,  // equal steps in the logarithm: saturation currents and shunt resistances span decades
};

// Role of a parameter in a law. It selects the scale on which the parameter is fitted, profiled and
// reported.
enum class ParameterKind {
  kPlain,         // linear
  kPhotocurrent,  // linear, in units of the largest current
  kSaturation,    // logarithm; refers to the ideality of its diode
  kIdeality,      // of a diode
  kSeries,        // linear
  kShunt,         // conductance
  kDarkShunt,     // conductance, between 1 and exp(-exponent) times that of its shunt
};

// Description of a parameter, independent of any curve. `symbol` is from the papers (tables, plots,
// flags), `name` from pvlib (code, JSON).
struct ParameterInfo {
  std::string symbol;  // "Rs"
  std::string name;    // "resistance_series"
  std::string unit;    // "ohm"; empty for pure numbers
  std::string doc;     // meaning, one line
  ParameterKind kind = ParameterKind::kPlain;
  double step = 1;  // natural size: kPlain in its unit, kPhotocurrent in largest currents
  // Positions in the same list of the parameters it refers to: the ideality of a saturation
  // current; the shunt and the exponent of a dark shunt.
  std::array<int, 2> with = {-1, -1};
};

// Position of a symbol or a name in a parameter list.
inline std::optional<int> FindParameter(const std::vector<ParameterInfo>& parameters,
                                        const std::string& symbol_or_name) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ParameterInfo& info = parameters[i];
    if (info.symbol == symbol_or_name || info.name == symbol_or_name) return static_cast<int>(i);
  }
  return std::nullopt;
}

// Key of the parameter in records: its name, or "shading.d" (EFFECT.SYMBOL) for an effect's
// parameter.
inline const std::string& ParameterKey(const ParameterInfo& info) {
  return info.symbol.find('.') == std::string::npos ? info.name : info.symbol;
}

// Intervals and profiles use the scale on which the sum of squares around an optimum is closest to
// a parabola: the logarithm of a saturation current, the conductance of a shunt, otherwise the
// value.
inline bool IsConductance(ParameterKind kind) {
  return kind == ParameterKind::kShunt || kind == ParameterKind::kDarkShunt;
}
inline double ToScale(ParameterKind kind, double value) {
  if (kind == ParameterKind::kSaturation) return std::log(value);
  return IsConductance(kind) ? 1 / value : value;
}
inline double FromScale(ParameterKind kind, double scaled) {
  if (kind == ParameterKind::kSaturation) return std::exp(scaled);
  return IsConductance(kind) ? 1 / scaled : scaled;
}
// Length on that scale of a short `step` at `value`.
inline double StepOnScale(ParameterKind kind, double value, double step) {
  if (kind == ParameterKind::kSaturation) return step / value;
  return IsConductance(kind) ? step / (value * value) : step;
}

// The interval of half-width `reach` (in the parameter's unit, at `value`) on that scale. The upper
// end of a shunt resistance is infinite if its conductance may be 0.
struct ParameterRange {
  double low;
  double high;
};
inline ParameterRange RangeAround(ParameterKind kind, double value, double reach) {
  const double middle = ToScale(kind, value);
  const double part = StepOnScale(kind, value, reach);
  if (!IsConductance(kind)) return {FromScale(kind, middle - part), FromScale(kind, middle + part)};
  const double infinity = kInfinity;
  return {1 / (middle + part), middle > part ? 1 / (middle - part) : infinity};
}

// Bounds of a parameter. The refinement respects [lower, upper]. The search draws from
// [search_lower, search_upper] inside it. That range is narrower where a bound is only a limit
// (diode current 0, infinite shunt resistance) and no plausible value.
struct ParameterBounds {
  double lower = 0;
  double upper = kUnknown;
  double search_lower = 0;         // in the parameter's unit
  double search_upper = kUnknown;  // NaN: not yet known
  SearchScale scale = SearchScale::kLinear;
  double whole = 0;  // step of the allowed values, counted from `lower`; 0: continuous
};

// The allowed value nearest to `value`.
inline double WithinBounds(const ParameterBounds& bounds, double value) {
  const double inside = std::fmin(std::fmax(value, bounds.lower), bounds.upper);
  if (bounds.whole == 0) return inside;
  return bounds.lower + bounds.whole * std::round((inside - bounds.lower) / bounds.whole);
}

}  // namespace lyrefit
