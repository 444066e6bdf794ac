// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// A single-diode curve through given ends: its Isc and Voc fix photocurrent and saturation current.
struct DiodeThroughEnds {
  double isc_A = kUnknown;
  double voc_V = kUnknown;
  double nNsVth = kUnknown;  // n Ns k T / q in V
  double series_ohm = 0;
  double shunt_S = 0;
};

// Fill factor of the curve, to rounding. NaN if no diode with a positive saturation current passes
// through the ends.
double FillFactorOf(const DiodeThroughEnds& diode);

// Splits the fill factor of a lit sweep with a single-diode fit. In this order: n from 1 to the
// fitted one, then the shunt, then the series resistance; each curve keeps Isc and Voc of the fit.
// The rest is the fitted minus the measured fill factor. Intervals are by the delta method from the
// covariance of the fit, in Iph, ln Is, n, Rs and 1/Rsh; losses by resistances are not below 0. n or
// a resistance at its bound has no standard error: the loss at the other end of its interval extends
// the interval of its part.
FillFactorLosses FindFillFactorLosses(const CellSweep& lit);

// Names the loss by the conductance at short circuit, "shunt or collection" of one light, after the
// split that several measurements tell (JointEstimate::collection_part).
void NameShuntLosses(const JointEstimate& joint, std::vector<FillFactorLosses>* all);

}  // namespace lyrefit
