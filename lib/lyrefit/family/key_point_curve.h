#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/data_sheet.h"
#include "lyrefit/family/key_point_solver.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {

// The curve through the three points for given n and Rs. `diode_A` is Is exp(Voc / (n Ns Vt)),
// since Is itself may underflow a double.
struct KeyPointCurve {
  double n;
  double rs;
  double photocurrent;
  double diode_A;
  double conductance;
  double slope_error;  // residual of dP/dV = 0 at the maximum power point, in A
};

// Values of a data sheet, with the thermal voltage of the module.
struct KeyPointSheet {
  const DataSheetValues& values;
  double thermal_V;  // Ns k T / q of the module
  ConstantSet constants;
  BandGap gap = {};
};

// The curve through Isc, Voc and (Vmp, Imp).
KeyPointCurve CurveThrough(const KeyPointSheet& sheet, double n, double rs);

// Upper bound of Rs. Beyond it the junction voltages of the points change their order.
double LargestResistance(const KeyPointSheet& sheet);

// The curve for n whose power is largest at (Vmp, Imp). None if that requires a negative Rs, 1/Rsh
// or Is.
std::optional<KeyPointCurve> PhysicalCurve(const KeyPointSheet& sheet, double n);

// Converts a curve to device parameters. Is is 0 if it underflows a double.
ReferenceDevice ToDevice(const KeyPointSheet& sheet, const KeyPointCurve& c);

// A device as shared parameters of De Soto's law; Rsh is infinite without a shunt.
std::vector<double> SharedOf(const Translation& at, const ReferenceDevice& device, double alpha,
                             const BandGap& gap);

}  // namespace lyrefit
