// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// One diode model for several measurements of a cell: the lit sweeps `lights` (indices into
// CellReport::sweeps, the brightest first), the dark sweep `dark` (-1: none) and all Suns-Voc traces.
// None for fewer than two of them. A measurement counts by the size of its residuals, not below its
// noise. Intervals are profiles, widened where neighbouring residuals share errors. A second diode of
// n = 2 is added where the measurements need it.
std::optional<JointEstimate> FindJointEstimate(const CellReport& report,
                                               const std::vector<int>& lights, int dark,
                                               const CellOptions& options,
                                               const Observer& observer = {});

}  // namespace lyrefit
