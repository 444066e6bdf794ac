#pragma once

#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Effort of a fit. kFull: several starts. kInPassing: the best probe only.
enum class Effort { kFull, kInPassing };

// Fits the law of `fit` with one more effect, all parameters free, from the best of the effect's
// probes. The sum of squares is never larger than that of `fit`, except for effects without a
// neutral value.
LawFit FitEffect(const WeightedData& weighted, const LawFit& fit, const Score& score,
                 Effort effort = Effort::kFull);

// Fits the law of `met` from its parameters. `met`: a fit with one more effect, to readings most of
// which are in these data too. Not usable if the effect ends at a bound that it must not reach.
LawFit FitOnwards(const WeightedData& weighted, const LawFit& met);

// Whether the misfit or the ideality of a fit is so large that scores and starts taken from it
// mislead.
bool LeadsAstray(const WeightedData& weighted, const LawFit& fit);

// Penalty for the parameters that a law frees beyond the default, in units of the noise variance:
// ln(readings) each (BIC).
double FreedomOf(const WeightedData& weighted, const Law& law);

// Fits the law of `fit` without effect number `index`, from the present parameters.
LawFit FitWithout(const WeightedData& weighted, const LawFit& fit, int index);

// Whether the last effect of a fit draws what it stands for, and not what another cause draws: it
// stays off the bounds that its parameters name and off what `Effect::imitates` rejects, and the cells
// without it give no more voltage than their technology can (DataTraits::most_open_circuit). Of an effect
// of the sweep or of the instrument also these: what changes from one reading to the next jumps
// there in the readings, no moment of light lies where a sweep from deep reverse passes 0 V, and none
// after which the light stays at another level lies in the knee or at a step of bypass diodes.
bool IsItself(const WeightedData& weighted, const LawFit& fit);

}  // namespace lyrefit
