#pragma once

#include <string>

#include "lyrefit/batch/plant_page.h"
#include "lyrefit/batch/plant_summary.h"

namespace lyrefit {

// "488 of 500 strings pass; 12 need work: 5 partial shading, ..., worth about 3.2 kW."
std::string PlantVerdict(const PlantSummary& summary);

// The verdict as HTML, for below the title.
std::string PlantHead(const PlantSummary& summary);

// What else is read without a script: zones, causes, the tree, the distribution, the worst and the
// broken strings, what was measured with. Elements whose ids begin
// with "live-" are empty and wait for the script.
std::string PlantBody(const PlantSummary& summary, const PlantPageOptions& options);

}  // namespace lyrefit
