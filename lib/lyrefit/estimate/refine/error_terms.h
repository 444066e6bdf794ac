#pragma once

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Sizes of the errors of one instrument and one device.
struct ErrorSizes {
  double current_A = 0;  // standard deviation of every independent current error
  double voltage_V = 0;  // of a voltage at Voc, which acts through the slope of the curve
  double path = 0;       // of the light along the sweep, relative, or of a similar model error
  // Distance along the sweep, in Voc, over which the path's correlation falls to 1 / e.
  double length = 1;
  // Standard deviation of an independent error in proportion to the current. Experimental.
  double current_part = 0;
};

// Whether all sizes agree within a relative `tolerance`.
bool AreClose(const ErrorSizes& a, const ErrorSizes& b, double tolerance);

// Errors of many curves of one device: those of readings, a path for each curve, and the errors
// common to all readings of one curve.
struct FamilyErrorSizes {
  ErrorSizes readings;
  double irradiance = 0;     // of a curve's stated irradiance, relative
  double temperature_K = 0;  // of its stated temperature
};

// Number of sizes in use; the simpler kinds are nested in the richer ones.
enum class FamilyErrorKind { kIndependent, kPath, kCurves };

template <>
struct EnumTable<FamilyErrorKind> {
  static constexpr EnumText<FamilyErrorKind> kRows[] = {
      {FamilyErrorKind::kIndependent, "independent"},
      {FamilyErrorKind::kPath, "path"},
      {FamilyErrorKind::kCurves, "curves"}};
};

}  // namespace lyrefit
