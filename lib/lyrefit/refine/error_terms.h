#pragma once

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// How large the errors of one instrument and one device are.
struct ErrorSizes {
  double current_A = 0;  // standard deviation of every current by itself
  double voltage_V = 0;  // of a voltage at Voc, which shows by the slope of the curve
  double path = 0;       // of the light, relative, along the sweep, or of what looks like it
  // Along the sweep, in Voc, over which the path's correlation falls to 1 / e.
  double length = 1;
};

// Whether each size is within a relative `tolerance` of the other's.
bool AreClose(const ErrorSizes& a, const ErrorSizes& b, double tolerance);

// Errors of many curves of one device: those of readings, a path for each curve, and what all
// readings of one curve share.
struct FamilyErrorSizes {
  ErrorSizes readings;
  double irradiance = 0;     // of a curve's stated light, relative
  double temperature_K = 0;  // of its stated temperature
};

// How many of the sizes there are: the simpler kinds are nested in the richer ones.
enum class FamilyErrorKind { kIndependent, kPath, kCurves };

template <>
struct EnumTable<FamilyErrorKind> {
  static constexpr EnumText<FamilyErrorKind> kRows[] = {
      {FamilyErrorKind::kIndependent, "independent"},
      {FamilyErrorKind::kPath, "path"},
      {FamilyErrorKind::kCurves, "curves"}};
};

}  // namespace lyrefit
