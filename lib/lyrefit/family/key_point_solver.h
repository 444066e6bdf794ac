#pragma once

#include <optional>

#include "lyrefit/base/constants.h"
#include "lyrefit/curve/data_sheet.h"
#include "lyrefit/model/default_values.h"

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

}  // namespace lyrefit
