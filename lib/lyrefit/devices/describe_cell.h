// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Describes the measurements of one cell: sweeps in any direction and number, under several lights
// and in the dark, and Suns-Voc traces. What the measurements allow is computed; for the rest the
// report names what is missing. Errors: no sweep with at least five readings, several devices (two
// lit sweeps of one direction under one light that are no repeats of one curve), an option outside
// its range.
Expected<CellReport> DescribeCell(const CurveSet& cell, const CellOptions& options = {},
                                  const Observer& observer = {});

}  // namespace lyrefit
