#pragma once

#include <limits>
#include <string>
#include <vector>

namespace lyrefit {

// How a search lays its steps over a parameter's range.
enum class SearchScale {
  kLinear,
  kLog,  // equal steps in the logarithm: saturation currents and shunt resistances span decades
};

// What a parameter is, independent of any curve. `symbol` is the papers' (tables, plots, flags),
// `name` is pvlib's (code, JSON).
struct ParameterInfo {
  std::string symbol;  // "Rs"
  std::string name;    // "resistance_series"
  std::string unit;    // "ohm"; empty for pure numbers
  std::string doc;
};

// Where a parameter may lie. The refinement respects [lower, upper]; the search draws from
// [search_lower, search_upper] inside it, which is narrower where a bound is only a limit (a diode
// may vanish, a shunt may be perfect) and no place to look for anything.
struct ParameterBounds {
  double lower = 0;
  double upper = std::numeric_limits<double>::quiet_NaN();
  double search_lower = 0;
  double search_upper = std::numeric_limits<double>::quiet_NaN();
  SearchScale scale = SearchScale::kLinear;
};

}  // namespace lyrefit
