#pragma once

#include <array>

#include "lyrefit/base/numbers.h"
#include "plant/string_plan.h"

namespace lyrefit {

// The scale of a string: the figures of its curve that faults change together without changing its
// shape.

// The column of the measured slope. Where a checkpoint has it, strings are judged by their scale.
inline constexpr char kSlopeColumn[] = "slope_ohm";

struct StringFigures {
  double isc_A = kUnknown;
  double voc_V = kUnknown;
  double imp_A = kUnknown;
  double vmp_V = kUnknown;
  double slope_ohm = kUnknown;  // -dV/dI at open circuit
};

// Logarithms of Isc, Voc, FF, Vmp / Voc and slope Isc / Voc. Light moves the first alone, nearly;
// lost modules the second alone; temperature the last four; resistance the last three. They are
// thus nearly independent of each other in healthy strings.
enum ScaleQuantity { kScaleIsc, kScaleVoc, kScaleFill, kScaleVmp, kScaleSlope, kScaleQuantities };
using ScaleVector = std::array<double, kScaleQuantities>;

ScaleVector LogsOf(const StringFigures& figures);
ScaleVector Difference(const ScaleVector& one, const ScaleVector& other);

// The figures that the plan expects at an irradiance in W/m2 and a cell temperature in K: those of
// its module's device times modules and strings. Cables have no resistance.
StringFigures FiguresByPlan(const PlannedString& line, double irradiance_W_m2,
                            double temperature_K);

// A whole string as one diode without a shunt, for the effect of faults on its figures. Only
// differences between its figures are used, so that a typical ideality suffices.
class ScaleDevice {
 public:
  // `cells`: in series; a number that does not go with Voc is replaced. `temperature_K`: NaN is 25 C.
  ScaleDevice(const StringFigures& figures, int cells, double temperature_K);

  int cells() const { return cells_; }

  // What the logarithms change by:
  ScaleVector ByLight(double factor) const;         // light times `factor`
  ScaleVector ByWarmth(double kelvin) const;        // cells warmer by `kelvin`
  ScaleVector ByResistance(double ohm) const;       // `ohm` more in series
  ScaleVector ByReversed(double of_modules) const;  // modules in reverse, as a part of all

 private:
  struct Diode {
    double photocurrent, saturation, series, scale_V;
  };
  static double VoltageAt(const Diode& diode, double current);
  // Logarithms of a string of which the part `reversed` stands in reverse.
  static ScaleVector LogsOfDiode(const Diode& diode, double reversed = 0);

  int cells_ = 1;
  double temperature_K_ = 298.15;
  Diode diode_{};
  ScaleVector healthy_{};
};

}  // namespace lyrefit
