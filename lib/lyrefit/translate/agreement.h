#pragma once

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Checks each linear interval against the drawn interval (JCGM 101, clause 8). Stores in every
// output of `budget` whether both ends agree within the numerical tolerance. Where they do not, the
// output's sentence states the reasons.
void JudgeAgreement(const UncertainModel& model, const UncertaintySources& sources,
                    int significant_digits, UncertaintyBudget* budget);

}  // namespace lyrefit
