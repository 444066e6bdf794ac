#pragma once

#include <optional>
#include <string>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Fill factor that new modules of crystalline silicon lose to series resistance under 1000 W/m2: of
// eight modules of HIT, IBC, PERC and other cells, flashed with Suns-Voc beside, 0.055 to 0.074.
// It scales with the light.
inline constexpr double kUsualResistanceLoss = 0.065;
inline constexpr double kUsualResistanceScatter = 0.006;  // standard deviation
inline constexpr double kMostResistanceLoss = 0.074;
// From so much more of the fill factor on, a resistance is a finding.
inline constexpr double kNotedResistanceLoss = 0.03;

// Whether it exceeds that of new modules, by what is a finding, and certainly.
bool IsNoted(const ResistanceLoss& loss);

// Whether a cause is a series resistance.
bool IsResistance(const Cause& cause);

// Of a module of silicon with a Suns-Voc trace beside a sweep, and no sweep under another light or at
// another temperature (a dark one may be there): from the maximum powers of trace and
// sweep where the sweep has no rise, else from the voltages between them at small currents, which
// every cell still gives. None for others, and if the readings do not reach the knee.
std::optional<ResistanceLoss> FindResistanceLoss(const Selection& selection,
                                                 const std::string& technology);

// Judges the resistances among the causes by that loss: those within the loss of new modules are none,
// the others recover what is beyond it. What a trace shows beyond it is a cause even if the fit named
// none, beside what else was named, if that cause is `wanted`.
void JudgeResistance(const ResistanceLoss& loss, const Selection& selection, bool wanted,
                     Verdict* verdict);

}  // namespace lyrefit
