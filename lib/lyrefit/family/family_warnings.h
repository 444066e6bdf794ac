#pragma once

#include <string>
#include <vector>

#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"

namespace lyrefit {

// Warnings that the reader of a report needs, as plain sentences.
std::vector<std::string> FamilyWarnings(const FamilyReport& report, const FamilyOptions& options);

}  // namespace lyrefit
