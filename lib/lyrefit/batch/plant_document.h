#pragma once

#include <string>

#include "lyrefit/batch/plant_page.h"
#include "lyrefit/batch/plant_summary.h"

namespace lyrefit {

// The summary as a sentence: "488 of 500 strings pass; 12 need work: 5 partial shading, ..., worth
// about 3.2 kW."
std::string PlantVerdict(const PlantSummary& summary);

// PlantVerdict as HTML, for the place below the title.
std::string PlantHead(const PlantSummary& summary);

// The parts of the page that need no script, as HTML. They are zones, causes, the tree, the
// distribution, the worst and the broken strings, and the measurement settings. Elements whose ids
// begin with "live-" are empty and are filled by the script.
std::string PlantBody(const PlantSummary& summary, const PlantPageOptions& options);

}  // namespace lyrefit
