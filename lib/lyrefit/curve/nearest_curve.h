#pragma once

#include <cstddef>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"

namespace LYREFIT_PUBLIC lyrefit {

// Position of the curve that was taken closest to an irradiance and cell temperature. The distance
// is that of (G / 1000 W/m2, T / 100 K), the spans of an outdoor record: 10 W/m2 count as much as 1
// K. Of two curves equally far the first; curves whose irradiance or temperature nobody stated do
// not take part. Errors: values that are no condition, a set without a curve whose conditions are
// known.
Expected<std::size_t> NearestCurve(const CurveSet& set, double irradiance_W_m2,
                                   double temperature_C);

// Position of the curve with that id. Errors: there is none.
Expected<std::size_t> FindCurve(const CurveSet& set, const std::string& id);

// "987.2 W/m2, 24.6 C"; "?" for what nobody stated.
std::string ConditionsText(const IvCurve& curve);

// How tables call a curve of a set: "sandia_pvue125/1234 (987.2 W/m2, 24.6 C)".
std::string LabelInSet(const CurveSet& set, const IvCurve& curve);

}  // namespace lyrefit
