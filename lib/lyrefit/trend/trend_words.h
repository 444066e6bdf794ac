#pragma once

#include <string>
#include <vector>

#include "lyrefit/trend/quantities.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Verdict, what is not decided, and warnings of a report that is complete otherwise.
std::string VerdictOf(const TrendReport& report, const TrendOptions& options);
std::vector<std::string> NotDecided(const TrendReport& report);
std::vector<std::string> FindWarnings(const TrendReport& report);

// Says from when on a series is of another device, and what changed.
std::string ExchangeWarning(const ExchangedDevice& exchange);

// "12 measurements, 2025-03-01 to 2025-03-12: no irradiance".
std::string ReasonText(const TrendReason& reason);

// Days in spans: "2025-03-03 to 2025-03-07, 2025-03-31".
std::string DaysText(const std::vector<double>& days_s);

// Whether the series is too short for rates a year.
bool IsBelowAYear(const TrendReport& report);

// "series resistance" for a part of a loss.
std::string PartTitle(const std::string& part);

}  // namespace lyrefit
