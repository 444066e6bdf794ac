#pragma once

#include <string>

#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// The whole report for a terminal: the verdict first, then each cause with its size and what else
// it could be, then the evidence. Every RMSE is solved-current and says so.
std::string DiagnosisText(const Diagnosis& diagnosis);

// One line.
std::string BriefDiagnosis(const Diagnosis& diagnosis);

}  // namespace lyrefit
