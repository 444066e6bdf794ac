#pragma once

#include <string>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/healthy_comparison.h"

namespace lyrefit {

// The comparison and, beside it, the diagnosis of what it leaves.
std::string HealthyJson(const HealthyComparison& comparison, const Diagnosis& diagnosis);

std::string OddSweepsJson(const OddSweeps& odd);

}  // namespace lyrefit
