// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Intervals of the first three are of the noise of the readings alone.

// Series resistance from two lit curves (Wolf and Rauschenbach 1963, doi:10.1016/0365-1789(63)90063-8):
// at equal Isc - I both have one junction voltage, so that Rs = (V2 - V1) / (Isc1 - Isc2). The point
// is the reading of largest power of the brighter curve.
SeriesResistance RsFromTwoLights(const CellSweep& brighter, const CellSweep& darker);

// From a lit and a dark curve: Rs = (V_dark(Isc - Imp) - Vmp - (Isc - Imp) Rs_dark) / Imp at the
// lit reading of largest power (Pysch 2007, doi:10.1016/j.solmat.2007.05.026). With `dark_rs_ohm` NaN
// the series resistance in the dark counts as equal: Rs = (V_dark(Isc - Imp) - Vmp) / Isc.
SeriesResistance RsFromDark(const CellSweep& lit, const CellSweep& dark, double dark_rs_ohm);

// From open-circuit voltages over light, which have no Rs in them: Rs = (Voc at the light
// Isc - Imp, minus Vmp) / Imp, at
// the reading of largest power. `points` rise in light.
SeriesResistance RsFromVoc(const CellSweep& lit, const std::vector<VocPoint>& points,
                           SweepKind source);

// The slope at Voc, an upper limit: n Ns kT / q Isc of the junction is in it.
SeriesResistance RsFromSlope(const CellSweep& lit);

// Rs of the fit with its interval.
SeriesResistance RsOfFit(const CellSweep& lit);

// The fit's estimate of a parameter, with the interval to believe; NaN if there is no fit.
Ranged FittedValue(const CellSweep& sweep, const std::string& symbol);

// Fill factor of the curve without Rs: Isc minus the light of each Voc. NaN if the points do not
// reach Isc and the maximum power.
double PseudoFillFactorOf(double isc_A, const std::vector<VocPoint>& points);

}  // namespace lyrefit
