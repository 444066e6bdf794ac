// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstddef>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"

namespace LYREFIT_PUBLIC lyrefit {

// Position of the curve measured nearest to an irradiance and a cell temperature in degrees
// Celsius. The distance is Euclidean in (G / 1000 W/m2, T / 100 K), the spans of an outdoor record,
// so that 10 W/m2 count as much as 1 K. The first of equally near curves is chosen. Curves without
// stated irradiance or temperature are ignored. Errors: impossible conditions; no curve with known
// conditions.
Expected<std::size_t> NearestCurve(const CurveSet& set, double irradiance_W_m2,
                                   double temperature_C);

// Position of the curve with an id. Error: no such curve.
Expected<std::size_t> FindCurve(const CurveSet& set, const std::string& id);

// Conditions as text: "987.2 W/m2, 24.6 C"; "?" for values that are not stated.
std::string ConditionsText(const IvCurve& curve);

// Label of a curve of a set in tables: "sandia_pvue125/1234 (987.2 W/m2, 24.6 C)".
std::string LabelInSet(const CurveSet& set, const IvCurve& curve);

}  // namespace lyrefit
