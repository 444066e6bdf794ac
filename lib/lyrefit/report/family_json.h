#pragma once

#include <string>

#include "lyrefit/family/family_report.h"

namespace lyrefit {

// The report as JSON, keys in a fixed order, pvlib's names for parameters. NaN is null. Every RMSE
// is a pair under the labels measured_current_A and solved_current_A.
std::string FamilyJson(const FamilyReport& report);

}  // namespace lyrefit
