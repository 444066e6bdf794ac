#pragma once

#include <string>

#include "lyrefit/diagnose/healthy_comparison.h"

namespace lyrefit {

// A sweep against healthy ones: what it says, the table of now against expected, who was compared.
std::string HealthyText(const HealthyComparison& comparison);
std::string BriefHealthy(const HealthyComparison& comparison);  // one line

// The sweeps of a module against each other: the odd ones first, each with its table; the others
// are counted.
std::string OddSweepsText(const OddSweeps& odd);
std::string BriefOddSweeps(const OddSweeps& odd);  // a line for each odd one, and one

}  // namespace lyrefit
