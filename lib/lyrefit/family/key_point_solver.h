#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/data_sheet.h"
#include "lyrefit/model/default_values.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {

constexpr double kVocStep_K = 2;  // step of the secant beta_oc, as in fit_desoto

// The band gap of De Soto's law at 25 C and its relative slope.
struct BandGap {
  double eV = kDefaultBandgap_eV;
  double slope_1_K = kDefaultBandgapSlope_per_K;
};

// The gap that a sheet states, or that of its technology; silicon's where that is not known.
BandGap GapOf(const DataSheet& sheet);

// The five parameters at the reference conditions.
struct ReferenceDevice {
  double photocurrent_A;
  double saturation_current_A;
  double n;  // per cell
  double resistance_series_ohm;
  double shunt_conductance_S;
};

// Reason why beta_oc cannot be met: Rs or 1/Rsh would be negative, or no n gives it.
enum class Border { kNone, kNoSeriesResistance, kPerfectShunt, kIdeality };

struct KeyPointSolution {
  ReferenceDevice device;
  Border border = Border::kNone;
  int solutions = 1;  // number of physical devices that satisfy all equations
};

// Solves all five equations of FitDataSheet. Given n and Rs, three of them are linear in Iph, Is
// and 1/Rsh. The slope at the maximum power point then determines Rs for every n, and beta_oc
// determines n. None if no n gives a physical curve through the points.
std::optional<KeyPointSolution> SolveKeyPoints(const DataSheetValues& values, int cells_in_series,
                                               const BandGap& gap, ConstantSet constants);

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
