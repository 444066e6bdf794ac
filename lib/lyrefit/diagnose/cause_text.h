#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// What a fit's effect number `index` means to a technician: lights of substrings in %, the voltage
// and the heat of a cell in reverse. Nothing where its sizes speak for themselves.
std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index);

// A cell that the others drive into reverse where the terminals are shorted.
struct HotCell {
  double voltage_V = 0;  // below 0
  double heat_W = 0;
};

// Of the law's `weak_cell` at `index`, under the brightest light.
HotCell FindHotCell(const WeightedData& weighted, const LawFit& fit, int index);

}  // namespace lyrefit
