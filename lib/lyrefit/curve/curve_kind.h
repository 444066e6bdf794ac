// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// What was measured. The first kinds are sweeps under light.
enum class CurveKind {
  kLit,              // from short circuit to open circuit
  kFlash,            // under a flash, with the light of each reading
  kBeginsAtVoltage,  // without short circuit
  kEndsEarly,        // without open circuit
  kFarBeyondVoc,     // to currents into the device that exceed its short-circuit current
  kDark,
  kSunsVoc,    // open-circuit voltages over light
  kIscVoc,     // short-circuit current and open-circuit voltage alone
  kKeyPoints,  // with the point of maximum power
  kOperatingPoints
};

template <>
struct EnumTable<CurveKind> {
  static constexpr EnumText<CurveKind> kRows[] = {
      {CurveKind::kLit, "lit"},
      {CurveKind::kFlash, "flash test"},
      {CurveKind::kBeginsAtVoltage, "begins at a voltage"},
      {CurveKind::kEndsEarly, "ends early"},
      {CurveKind::kFarBeyondVoc, "far beyond Voc"},
      {CurveKind::kDark, "dark"},
      {CurveKind::kSunsVoc, "Suns-Voc"},
      {CurveKind::kIscVoc, "Isc-Voc"},
      {CurveKind::kKeyPoints, "key points"},
      {CurveKind::kOperatingPoints, "operating points"},
  };
};

// A kind and its sentence part: "dark: no current flows at 0 V". Empty for kLit.
struct KindOfMeasurement {
  CurveKind kind = CurveKind::kLit;
  std::string words;  // what the sweep lacks or has too much of
};

// The kind of a curve that passes Validate. Of several that hold, the last of the list above counts;
// `words` has all that concern the extent of a sweep.
KindOfMeasurement KindOf(const IvCurve& curve);

// Whether the light was recorded beside each reading of a sweep that took less than the longest
// pulse of a solar simulator, half a second.
bool IsFlash(const IvCurve& curve);

// Whether readings are operating points of a day, one voltage at a time, and no sweep: at least 10
// of them over two hours or more, and a voltage that wanders. The voltage of a sweep, also of a slow
// one, keeps its direction from reading to reading; that of a maximum power point goes up and down
// with temperature and light. Both lists have one value a reading.
bool OperatingPointsOfADay(const std::vector<double>& time_s, const std::vector<double>& voltage_V);

// "operating points of a day: 85 readings over 14.0 hours, not a sweep: ..." with the way out.
std::string OperatingPointsWords(const std::vector<double>& time_s);

}  // namespace lyrefit
