#pragma once

#include <string>
#include <vector>

#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Verdict, what is not decided, and warnings of a report that is complete otherwise.
std::string VerdictOf(const TrendReport& report, double least_irradiance_W_m2);
std::vector<std::string> NotDecided(const TrendReport& report);
std::vector<std::string> FindWarnings(const TrendReport& report);

// "series resistance" for a part of a loss.
std::string PartTitle(const std::string& part);

}  // namespace lyrefit
