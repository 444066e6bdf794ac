#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/study/comparison.h"

namespace lyrefit {

// Share of runs that hit against evaluations, for algorithms of BudgetAlgorithms(). Each problem is
// a row of panels and each polish level a column.
Expected<void> PlotBudget(const Comparison& comparison, const std::string& path);

}  // namespace lyrefit
