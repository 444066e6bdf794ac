// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Formats a curve as a table that ReadCurve accepts: voltage_V, current_A and the optional columns
// in use. The digits suffice to restore the same bits.
std::string CurveToCsv(const IvCurve& curve);

// The sidecar of that table: conditions and notes as JSON.
std::string CurveSidecarJson(const IvCurve& curve);

}  // namespace lyrefit
