#pragma once

#include <string>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// What a comparison says to a terminal of 100 columns; "-" stands for what is not known, every
// table names the objective. All end with a newline.

// For each problem: the RMSE of the search alone and after the polish, what they cost, how often
// they hit, and what the rank tests make of it.
std::string CompareText(const Comparison& comparison);

// Contenders of BudgetContenders(): hits by algorithm and budget, one table a polish level.
std::string BudgetText(const Comparison& comparison);

// Contenders of SensitivityContenders(): grids of Pm and gamma.
std::string SensitivityText(const Comparison& comparison);

}  // namespace lyrefit
