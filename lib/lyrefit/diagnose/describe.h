#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/held_out.h"
#include "lyrefit/diagnose/weighted_data.h"

namespace lyrefit {

// Parameters of effect `index` of a fit in reporting units, with symmetric 95 % intervals cut at
// the bounds.
std::vector<CauseParameter> DescribeParameters(const WeightedData& weighted, const LawFit& fit,
                                               int index);

// One trial for each of the `known` effects, whether fitted or not.
std::vector<Trial> DescribeTrials(const Readings& readings, const Selection& selection,
                                  const std::vector<const Effect*>& known,
                                  const std::vector<const Effect*>& candidates,
                                  const HeldOutErrors& held_out, const DiagnoseOptions& options);

// A cause without size and place. `evidence`: "fit" or "values".
Cause MakeCause(const Effect& effect, const char* evidence, double probability);

// A size whose interval does not go below 0.
Sized NotBelowZero(const Sized& size);

// The causes found, their equivalents and the readings at which they act.
std::vector<Cause> DescribeCauses(const Selection& selection, const AtReadings& at,
                                  const ValueFindings& values);

// The findings of the effects that were tried with the base model alone, most probable first.
std::vector<Alternative> TriedAlone(const Selection& selection);

// Fills what the device would give more without the causes, all together, and whether that is a
// lower limit. The causes are described.
void DescribeRecoverable(const Selection& selection, Verdict* verdict);

// Significant effects that are too small to be named: the best one, with its equivalents.
std::vector<Cause> DescribeBelow(const Selection& selection);

// Base parameters and maximum power of the device, with and without the causes.
std::vector<ParameterShift> DescribeShifts(const Selection& selection);

// Size of effect number `index` of a fit for a technician: in the effect's own words
// (Effect::in_words), else the largest change of the current. `strength`: its parameters as reported,
// whose intervals are repeated.
std::vector<std::string> InWords(const WeightedData& weighted, const LawFit& fit, int index,
                                 const std::vector<CauseParameter>& strength);

}  // namespace lyrefit
