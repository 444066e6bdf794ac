#pragma once

#include <string>

#include "lyrefit/family/family_report.h"

namespace lyrefit {

// The whole report for a terminal. Every RMSE stands under its label: measured-current or
// solved-current. A report without shared parameters is that of curves fitted one by one.
std::string FamilyText(const FamilyReport& report);

// One line.
std::string BriefFamily(const FamilyReport& report);

}  // namespace lyrefit
