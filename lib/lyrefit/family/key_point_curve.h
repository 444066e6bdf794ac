#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/family/key_point_solver.h"
#include "lyrefit/law/translation.h"

namespace lyrefit {

// A place where f changes its sign between a and b, to the last bit.
template <class F>
double SignChange(const F& f, double a, double b) {
  const bool positive = f(a) > 0;
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (a + b);
    if (middle == a || middle == b) break;
    ((f(middle) > 0) == positive ? a : b) = middle;
  }
  return 0.5 * (a + b);
}

// The curve through the three points for given n and Rs. `diode_A` is Is exp(Voc / (n Ns Vt)): Is
// itself may be too small for a double.
struct KeyPointCurve {
  double n;
  double rs;
  double photocurrent;
  double diode_A;
  double conductance;
  double slope_error;  // of dP/dV = 0 at the maximum power point, in A
};

// What a data sheet says, and of how many cells at which temperature.
struct KeyPointSheet {
  const DataSheetValues& values;
  double thermal_V;  // of the module
  ConstantSet constants;
};

// Points on the curve: Isc, Voc, (Vmp, Imp).
KeyPointCurve CurveThrough(const KeyPointSheet& sheet, double n, double rs);

// No series resistance is larger: beyond it the voltages at the junction change their order.
double LargestResistance(const KeyPointSheet& sheet);

// The curve for n whose power is largest where it should be; nothing if that takes a negative
// Rs, 1/Rsh or Is.
std::optional<KeyPointCurve> PhysicalCurve(const KeyPointSheet& sheet, double n);

// Is of a curve is 0 where it is too small for a double.
ReferenceDevice ToDevice(const KeyPointSheet& sheet, const KeyPointCurve& c);

// A device as shared parameters of De Soto's law, of silicon; Rsh is infinite for no shunt.
std::vector<double> SharedOf(const Translation& at, const ReferenceDevice& device, double alpha);

}  // namespace lyrefit
