// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// ReadMeasurement() of several files of one cell. A Suns-Voc trace in suns needs the short-circuit
// current at one sun: where `options` have none, it is that of the brightest lit curve, over its
// irradiance.
Expected<CurveSet> ReadCell(const std::vector<std::string>& files, const ReadOptions& options = {});

}  // namespace lyrefit
