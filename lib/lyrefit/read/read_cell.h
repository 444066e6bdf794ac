// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// ReadMeasurement() of several files of one cell. A Suns-Voc trace in suns needs the short-circuit
// current at one sun: where `given` has none, it is that of the brightest lit curve, over its
// irradiance. `unstated_W_m2`: the light of the lit curves that state none; where it is not given
// either, a trace in suns assumes 1000 W/m2. Current densities without an area are those of 1 cm2
// (IvCurve::per_area), or of the area that another curve states. Errors beside those of reading:
// densities beside currents of an unknown area, and a light given to several curves that all state theirs.
Expected<CurveSet> ReadCell(const std::vector<std::string>& files, const ReadOptions& given = {},
                            std::optional<double> unstated_W_m2 = {});

}  // namespace lyrefit
