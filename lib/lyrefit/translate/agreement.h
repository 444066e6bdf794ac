#pragma once

#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// JCGM 101, clause 8: whether each end of the linear interval lies within the tolerance of the
// drawn one; where not, the sentence that says why.
void JudgeAgreement(const UncertainModel& model, const UncertaintySources& sources,
                    int significant_digits, UncertaintyBudget* budget);

}  // namespace lyrefit
