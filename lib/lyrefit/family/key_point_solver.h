#pragma once

#include <optional>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/data_sheet.h"

namespace lyrefit {

constexpr double kSiliconBandGap_eV = 1.121;
constexpr double kSiliconBandGapSlope_1_K = -0.0002677;
constexpr double kVocStep_K = 2;  // step of the secant beta_oc, as in fit_desoto

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
                                               ConstantSet constants);

}  // namespace lyrefit
