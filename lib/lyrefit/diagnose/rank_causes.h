#pragma once

#include <vector>

#include "lyrefit/diagnose/fitted_candidate.h"

namespace lyrefit {

// Whether a fitted effect has a physically possible size. Rejected: a strength at its bound, a
// temperature drift too fast for a sweep, less than one cell, an ideality that only this effect
// made impossible. `before`: the fit without it.
bool HasPossibleSize(const Readings& readings, const LawFit& before, const FittedCandidate& fitted);

// Whether the current rises with the voltage. No module does so by itself, so the irradiance
// changed. Always false for sweeps up and down, where stored charge has the same effect.
bool LightMoved(const Readings& readings);

// Whether an effect is flexible enough to imitate any shape. For a sweep in one direction: effects
// of the sweep, a range switch of the instrument, a clip at which no reading stands. For sweeps up
// and down: momentary effects.
bool IsGeneric(const Readings& readings, const Effect& effect);

// Position of the preferred cause among fitted candidates (best first, none of an impossible size).
//
// Specific causes in the device are preferred to generic ones that explain about as much. Generic
// are flexible effects (IsGeneric) and fits whose ideality no junction has. Among effects that
// divide the cells into groups, simple ones are preferred to complex ones.
//
// "About as much" means nearly the same statistic, with at most `floor` of `misfit` left beyond it
// (root mean squares, fractions of Isc). It also holds if the lack of fit is equal to within a
// fraction of the floor. If the current rises with the voltage, an effect of the sweep is selected
// (LightMoved). For one sweep, an irradiance step is preferred to a large range error, which is
// less likely.
std::size_t RankCauses(const WeightedData& weighted,
                       const std::vector<FittedCandidate>& fitted_candidates, double misfit,
                       double floor);

}  // namespace lyrefit
