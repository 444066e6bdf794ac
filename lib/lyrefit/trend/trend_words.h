#pragma once

#include <string>

#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Fills verdict, what is not decided, and warnings of a report that is complete otherwise.
void AddWords(TrendReport* report);

// "series resistance" for a part of a loss.
std::string PartTitle(const std::string& part);

}  // namespace lyrefit
