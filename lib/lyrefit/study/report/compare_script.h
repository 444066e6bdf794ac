#pragma once

#include <string>
#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// gnuplot commands that draw a comparison on standard output. `terminal` is "svg" or "png".
std::string BoxScript(const Comparison& comparison, const std::string& terminal);
std::string ConvergenceScript(const Comparison& comparison, const std::string& terminal);
std::string BudgetScript(const Comparison& comparison, const std::string& terminal);
// pool_script.cc: the same of pooled problems.
std::string PoolScript(const Comparison& comparison, const std::string& terminal);

}  // namespace lyrefit
