#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// How a search lays its steps over a parameter's range.
enum class SearchScale {
  kLinear,
  kLog,  // equal steps in the logarithm: saturation currents and shunt resistances span decades
};

// What a parameter does in a law decides on which scale it is fitted, profiled and quoted.
enum class ParameterKind {
  kPlain,         // linear
  kPhotocurrent,  // linear, in parts of the largest current
  kSaturation,    // logarithm; goes with the ideality of its diode
  kIdeality,      // of a diode
  kSeries,        // linear
  kShunt,         // conductance
  kDarkShunt,     // conductance, between that of the shunt it goes with and exp(-exponent) of it
};

// What a parameter is, independent of any curve. `symbol` is the papers' (tables, plots, flags),
// `name` is pvlib's (code, JSON).
struct ParameterInfo {
  std::string symbol;  // "Rs"
  std::string name;    // "resistance_series"
  std::string unit;    // "ohm"; empty for pure numbers
  std::string doc;     // what it is, one line
  ParameterKind kind = ParameterKind::kPlain;
  double step = 1;  // natural size, of kPlain in its unit, of kPhotocurrent in largest currents
  // Positions in the same list of what it goes with: the ideality of a saturation current; the
  // shunt and the exponent of a dark shunt.
  std::array<int, 2> with = {-1, -1};
};

// The position of a symbol or a name in such a list.
inline std::optional<int> FindParameter(const std::vector<ParameterInfo>& parameters,
                                        const std::string& symbol_or_name) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const ParameterInfo& info = parameters[i];
    if (info.symbol == symbol_or_name || info.name == symbol_or_name) return static_cast<int>(i);
  }
  return std::nullopt;
}

// What it stands under in records: its name or, of an effect's, "shading.d", EFFECT.SYMBOL.
inline const std::string& ParameterKey(const ParameterInfo& info) {
  return info.symbol.find('.') == std::string::npos ? info.name : info.symbol;
}

// The scale on which the sum of squares around an optimum is closest to a parabola, which intervals
// and profiles are laid out on: the logarithm of a saturation current, the conductance of a shunt,
// the rest as they are.
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
// The length on that scale of a short `step` from `value`.
inline double StepOnScale(ParameterKind kind, double value, double step) {
  if (kind == ParameterKind::kSaturation) return step / value;
  return IsConductance(kind) ? step / (value * value) : step;
}

// What lies within `reach` (in the parameter's unit, at `value`) on either side on that scale. A
// shunt that may be perfect has no upper end.
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

// Where a parameter may lie. The refinement respects [lower, upper]; the search draws from
// [search_lower, search_upper] inside it, which is narrower where a bound is only a limit (a diode
// may vanish, a shunt may be perfect) and no place to look for anything.
struct ParameterBounds {
  double lower = 0;
  double upper = kUnknown;
  double search_lower = 0;         // in the parameter's unit
  double search_upper = kUnknown;  // NaN: not known yet
  SearchScale scale = SearchScale::kLinear;
  double whole = 0;  // the values it may have lie so far apart, from `lower` on; 0: all between
};

// The value nearest to `value` that it may have.
inline double WithinBounds(const ParameterBounds& bounds, double value) {
  const double inside = std::fmin(std::fmax(value, bounds.lower), bounds.upper);
  if (bounds.whole == 0) return inside;
  return bounds.lower + bounds.whole * std::round((inside - bounds.lower) / bounds.whole);
}

}  // namespace lyrefit
