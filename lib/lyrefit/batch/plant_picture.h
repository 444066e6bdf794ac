#pragma once

#include <string>

#include "lyrefit/batch/plant_summary.h"

namespace lyrefit {

// The plant's tree as SVG: a cell for each node of the deepest level that has few enough of them, a
// row of cells for each node above. Empty without a tree.
std::string MapPicture(const PlantSummary& summary);

// Strings by performance factor as SVG, with its sentence. Empty where none is known.
std::string PerformancePicture(const PlantSummary& summary);

// The sign that stands beside the colour of a zone, as HTML; empty for a zone that is not known.
std::string ZoneMark(const std::string& zone);

}  // namespace lyrefit
