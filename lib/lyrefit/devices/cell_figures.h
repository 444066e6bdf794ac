// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/devices/cell_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Compares two lit sweeps of opposite directions under one light. Both must hold key points; the
// indices of the result are 0. `least_percent`: smallest gap that counts as hysteresis. Curves are
// interpolated linearly; the gap is the root mean square over 1001 even voltages, up to the end of
// the shorter sweep where that is below Voc. Sweeps may begin up to 5 % of Voc above 0 V.
DirectionPair CompareDirections(const CellSweep& forward, const CellSweep& reverse,
                                double least_percent);

// Pairs each forward with the next unpaired reverse sweep under its light (within 2 %), of its rate
// and its hours where both state them, or the other way round.
std::vector<DirectionPair> FindPairs(const std::vector<CellSweep>& sweeps, double least_percent);

// What the gap of the directions does over the rate (doi:10.1039/C4EE03664F): charge of a capacitance
// and late readings grow with it, ions have a rate at which they are largest, drift goes with the
// time that a sweep takes. Leaves each pair the causes that its rates allow. None: the pairs state
// fewer than two rates.
std::optional<HysteresisOverRate> CompareRates(const std::vector<CellSweep>& sweeps,
                                               std::vector<DirectionPair>* pairs);

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

// Intervals of the first three are of the noise of the readings and of what the method leaves out:
// shunt and collection, by the conductances at short circuit.

// Series resistance from two lit curves (Wolf and Rauschenbach 1963, doi:10.1016/0365-1789(63)90063-8):
// at equal Isc - I both have one junction voltage, so that Rs = (V2 - V1) / (Isc1 - Isc2). The point
// is the reading of largest power of the brighter curve.
SeriesResistance RsFromTwoLights(const CellSweep& brighter, const CellSweep& darker);

// From a lit and a dark curve: Rs = (V_dark(Isc - Imp) - Vmp - (Isc - Imp) Rs_dark) / Imp at the
// lit reading of largest power (Pysch 2007, doi:10.1016/j.solmat.2007.05.026). With `dark_rs` NaN
// the series resistance in the dark counts as equal: Rs = (V_dark(Isc - Imp) - Vmp) / Isc.
SeriesResistance RsFromDark(const CellSweep& lit, const CellSweep& dark, const Ranged& dark_rs);

// From open-circuit voltages over light, which have no Rs in them: Rs = (Voc at the light
// Isc - Imp, minus Vmp) / Imp, at
// the reading of largest power.
SeriesResistance RsFromVoc(const CellSweep& lit, const IdealityOverLight& over);

// The slope at Voc, an upper limit: n Ns kT / q Isc of the junction is in it.
SeriesResistance RsFromSlope(const CellSweep& lit);

// Rs of the fit with its interval.
SeriesResistance RsOfFit(const CellSweep& lit);

// The fit's estimate of a parameter, with the interval to believe; NaN if there is no fit.
Ranged FittedValue(const CellSweep& sweep, const std::string& symbol);

// Fill factor of the curve without Rs: Isc minus the light of each Voc. NaN if the points do not
// reach Isc and the maximum power.
double PseudoFillFactorOf(double isc_A, const std::vector<VocPoint>& points);

// n from open-circuit voltages over light (see IdealityOverLight); none for fewer than two points.
// `module_thermal_voltage_V`: Ns k T / q. The interval of n is that of the slope of a least-squares
// line, for three points and more. `isc_A`: of the lit curve whose n is compared; NaN: the brightest
// light counts.
std::optional<IdealityOverLight> FindIdealityOverLight(std::vector<VocPoint> points,
                                                       double module_thermal_voltage_V,
                                                       double isc_A = kUnknown);

// The points of a series of lit sweeps: one a light, the mean Isc and Voc of its sweeps. The sweeps
// are those of one file and direction where one has every light, else all.
std::vector<VocPoint> PointsOfLights(const std::vector<CellSweep>& sweeps);
// The points of a Suns-Voc trace, without those in the dark.
std::vector<VocPoint> PointsOfTrace(const CellSweep& sweep);

// Voc at a light, linear in the logarithm of the light between points; NaN outside them.
double VocAt(const std::vector<VocPoint>& points, double light_A);

// Local ideality of a dark curve without its shunt current, V times the slope at 0 V of the readings
// with |V| <= 25 mV per cell (at least three). Slopes of ln J are of the readings within 50 mV per
// cell, at least five. A reading counts if J without the shunt is above half of J and above ten
// times the noise. NaN where there are none.
DarkIdeality FindDarkIdeality(const CellSweep& dark, double module_thermal_voltage_V, int cells);

}  // namespace lyrefit
