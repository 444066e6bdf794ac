#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/curve/check_readings.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/key_points.h"

namespace lyrefit {

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
