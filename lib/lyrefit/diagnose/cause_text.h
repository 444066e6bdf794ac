#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Size of effect number `index` of a fit for a technician: light of substrings in %, voltage and
// heat of a cell in reverse, else the largest change of the current. `strength`: its parameters as
// reported, whose intervals are repeated.
std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength);

// A cell in reverse bias while the terminals are shorted.
struct HotCell {
  double voltage_V = 0;  // below 0
  double heat_W = 0;
};

// For the effect `weak_cell` at `index` of the law, under the brightest light.
HotCell FindHotCell(const WeightedData& weighted, const LawFit& fit, int index);

}  // namespace lyrefit
