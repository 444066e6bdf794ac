#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/devices/cell_options.h"
#include "lyrefit/devices/cell_report.h"
#include "lyrefit/devices/line.h"

namespace lyrefit {

// The readings of a sweep as a line.
inline Line LineOf(const CellSweep& sweep) { return {sweep.voltage_V, sweep.current_A}; }

// A monotone stretch of a measured curve, and its figures without a fit.
struct MeasuredSweep {
  IvCurve curve;  // of this sweep alone
  CellSweep sweep;
};

// The sweeps of a curve: by their numbers, else by the turns of the voltage. A stretch of fewer
// than five readings is left out. `area_cm2` may be NaN.
std::vector<MeasuredSweep> FindSweeps(const IvCurve& curve, double area_cm2);

// Resistances -dV/dI at 0 V and at Voc. The first is from the line of least squares through the
// readings with |V| <= Voc / 10, the second from that through the readings with |I| <= Isc / 10;
// each through at least the three nearest readings. NaN if the current does not fall there.
double ResistanceAtIsc(const Line& line, const KeyPoints& key);
double ResistanceAtVoc(const Line& line, const KeyPoints& key);

// See CellSweep::least_slope_ratio. Slopes are of the readings within 8 % of Voc, at least five; a
// ratio counts if both slopes differ by five times the error of their difference, by `noise_A` or by
// the scatter around the line, and past the knee, where the larger one is above Isc / Voc: slopes of
// the flat part are of light and devices that settle.
double LeastSlopeRatio(const Line& line, const KeyPoints& key, double noise_A);

// The sweep with a fit of the single-diode model. In the dark, the photocurrent is fixed at 0.
CellSweep FitCellSweep(MeasuredSweep measured, const CellOptions& options,
                       const Observer& observer);

// Sweeps whose readings allow figures, and a warning of each other one.
struct AcceptedSweeps {
  std::vector<MeasuredSweep> sweeps;
  std::vector<std::string> warnings;
};

// Leaves out the sweeps whose readings allow no figures. Error: all are left out.
Expected<AcceptedSweeps> LeaveOutRefused(std::vector<MeasuredSweep> measured);

// The results that a file states for a sweep, beside the figures of the sweep in the same units.
// Results of other quantities, such as resistances, whose definitions differ, are left out.
// `area_cm2` may be NaN. A voltage or a power without a unit is in V and mW/cm2, or in mV and mW
// where those are nearer.
std::vector<StatedKeyPoint> CompareStated(const std::vector<StatedResult>& results,
                                          const CellSweep& sweep, double area_cm2);

// Completes the hours of sweeps by the dates of their files, since the first one, and makes names
// differ: by rate and hours where those do, else by numbers.
void NameApart(const CurveSet& cell, std::vector<CellSweep>* sweeps);

// Which sweeps of a cell a figure is made of. Results are positions in CellReport::sweeps.

// Isc of a sweep that passes 0 V; else NaN.
double ReachedIsc(const CellSweep& sweep);

// Brightest lit sweep, of equals the first; -1: none is lit.
int BrightestOf(const std::vector<CellSweep>& sweeps);

// First sweep of this kind, one of the direction of `like` before others; -1: none.
int FindSweep(const CellReport& report, SweepKind kind, const CellSweep& like);

// Lit sweeps of the direction of `main`, one a light, the brightest first. Those count that `isc_of`
// gives an Isc.
std::vector<int> LightsOf(const CellReport& report, double (*isc_of)(const CellSweep&));

// Lit sweeps of the light of `main`, of both directions.
std::vector<int> BrightestSweeps(const CellReport& report);

}  // namespace lyrefit
