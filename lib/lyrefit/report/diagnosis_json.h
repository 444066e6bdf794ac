#pragma once

#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// The diagnosis as one JSON object, numbers with as many digits as bring back the same bits. What
// is not known or not finite is null. Points are named by their position in `points`. Apart from
// `seconds` the same seed gives the same text.
std::string DiagnosisJson(const Diagnosis& diagnosis);

// Several as an array.
std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses);

// The bare answers, for scripts that score many: {"name": [["cause", "equivalent", ...], ...]}, an
// empty list where no cause was found. One name for each diagnosis.
std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses);

}  // namespace lyrefit
