// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Series resistances that are taken off before the curves are compared, in ohm.
struct SeriesOhms {
  double lit = 0;   // of the lit curve
  double dark = 0;  // of the dark curve
};

// Tests superposition: J_light = Jsc - J_dark at equal voltage of the junction, V + J Rs. The
// readings of the lit curve from 0 V to Voc are compared; the dark current is interpolated in its
// logarithm. `least_percent`: smallest rms departure that counts, of Jsc; it must also be above
// three times the noise. NaN figures where the dark curve does not reach Voc.
Superposition TestSuperposition(const CellSweep& lit, const CellSweep& dark,
                                const SeriesOhms& series, double least_percent);

}  // namespace lyrefit
