#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/curve/assumption.h"
#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {

// Finds runs of exactly equal currents or voltages at an end of the curve. Such a run is a limit of
// the source or the load unless the resolution of the instrument explains it. All findings are
// doubts and list their points.
//
// Equal currents at the high-voltage end are a finding if the slope before them would have
// continued visibly. An illuminated device is flat at the low-voltage end, and a coarse instrument
// repeats readings there. Equal currents there are a finding only after a corner sharper than a
// diode's. Equal voltages are a finding if their currents differ and no readings elsewhere repeat.
std::vector<ReadingFinding> FindEqualReadings(const IvCurve& curve);

// Leaves out the readings at the stated current limit of the source (compliance_A): those from the
// highest voltage down whose current is against the generator and within 0.2 % of the limit. Says
// so in `assumptions`. Does nothing if fewer than four readings would remain.
void LeaveOutLimited(IvCurve* curve);

// Leaves out the rows at the end, from row `begin` on, that hold exactly 0 V and 0 A although the
// sweep does not come there: a shorter column of a table is padded with them. Returns their number.
std::size_t LeaveOutPadding(std::size_t begin, IvCurve* curve);

// Whether readings are whole numbers, and large ones, as the registers of an inverter hold them.
bool AreWholeNumbers(const std::vector<double>& readings);

// Says that a line of the head, "line 3 'Temp1: 45'", speaks of a temperature that was not used.
Assumption LeftTemperature(const std::string& line);

// Whether LeftTemperature made an assumption.
bool IsLeftTemperature(const Assumption& assumption);

using Findings = std::vector<ReadingFinding>;

inline constexpr double kLowestCell_V = 0.2;
inline constexpr double kHighestCell_V = 1.6;   // where no technology is stated
inline constexpr double kHighestStack_V = 5.5;  // of one cell with several junctions

// Quantities that the checks after LookForOverflow and LookForNothing share.
struct Examined {
  const IvCurve& curve;
  KeyPoints key;
  double largest_A = 0;
  double largest_V = 0;
  double delivered_A = 0;  // the largest current at forward voltage
  bool lit = false;
};

// Checks the voltage of a cell under light against what cells and the stated technology give.
void LookAtCells(const Examined& look, Findings* out);

// Finds magnitudes that no device has, usually because of a wrong unit. No finding refuses the
// curve, but results that depend on these magnitudes are unreliable. CheckReadings includes the
// findings. The ids are:
//   current   Isc, scaled to 1000 W/m2 if the irradiance is stated, above 100 A a string, or above
//             70 mA/cm2 if the area of a cell is stated (less for a stated technology); below 20 mA a string of 30 cells or more,
//             from a stated 100 W/m2 on
//   efficiency  above the limit of a junction (or of a stack, if no technology is stated)
//   shape     a fill factor above 0.95 or below 0.1
//   temperature  above 95 C for a module (30 cells or more) in light
std::vector<ReadingFinding> CheckPlausibility(const IvCurve& curve);

// Reason why results for this curve would be unreliable; nullopt if there is none. The power is
// checked first: Pmax above 3 times or below 1/300 of the rated power of the whole device, in W.
// The lower limit is proportional to the irradiance and applies from a stated 200 W/m2 on. The
// first finding of CheckReadings on a magnitude, a sign or a unit follows; the number of cells, which
// batches rarely state, is no reason.
std::optional<std::string> PlausibilityProblem(const IvCurve& curve,
                                               std::optional<double> rated_power_W = std::nullopt);

}  // namespace lyrefit
