#pragma once

#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Whether a fitted effect has a size that it can have: no strength at its bound, no drift of the
// temperature that a sweep has no time for, no part of a cell, no ideality that only the effect
// made impossible. `before`: the fit without it.
bool HasPossibleSize(const Readings& readings, const LawFit& before, const FittedCandidate& fitted);

// Whether the current rises with the voltage, which no module does by itself: the light moved. Of
// sweeps up and down nothing is said: charge does that to one of them.
bool LightMoved(const Readings& readings);

// Whether an effect bends to whatever shape there is: anything that happens during a sweep in one
// direction, a jump of the instrument's range or a limit that no reading stands at, of one in both
// a moment.
bool IsGeneric(const Readings& readings, const Effect& effect);

// Which of the fitted candidates is the cause, where more than noise and known causes bend the curve (candidates:
// the best first, none of an impossible size). A cause in the device is preferred to what bends to
// anything (a moment of the sweep, or a fit that leaves no junction's ideality) and explains about
// as much, a simple one to a complex one. About as much: nearly the same statistic, with no more
// than `floor` left beyond it of the `misfit` there was (root mean squares, parts of Isc); or as
// little left to within a part of the floor. Where the current rises with the voltage, which no
// module does by itself, the light moved. A cloud is likelier than a range that is wrong by so
// much, where no second sweep tells them apart.
std::size_t RankCauses(const WeightedData& weighted, const std::vector<FittedCandidate>& fitted_candidates, double misfit,
                   double floor);

}  // namespace lyrefit
