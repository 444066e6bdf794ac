#pragma once

#include "lyrefit/diagnose/score.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// In passing, an effect is tried from its best probe alone; for the record, briefly as well.
enum class Effort { kFull, kInPassing, kForTheRecord };

// `fit`'s law with one more effect, all parameters free, from the best of the effect's probes;
// never worse than `fit` itself but for the effects that have no neutral value.
LawFit FitEffect(const WeightedData& weighted, const LawFit& fit, const Score& score,
                 Effort effort = Effort::kFull);

// The law of `met`, a fit with one more effect to readings of which most are in these data too,
// from where that ended.
LawFit FitOnwards(const WeightedData& weighted, const LawFit& met);

// Whether a law is so far off, by misfit or ideality, that what is seen or fitted from it misleads.
bool LeadsAstray(const WeightedData& weighted, const LawFit& fit);

// What a law pays for the parameters that it lets go, in units of the noise variance.
double FreedomOf(const WeightedData& weighted, const Law& law);

// `fit`'s law without effect number `index`, from where it stands.
LawFit FitWithout(const WeightedData& weighted, const LawFit& fit, int index);

}  // namespace lyrefit
