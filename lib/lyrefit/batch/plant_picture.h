#pragma once

#include <string>

#include "lyrefit/batch/plant_summary.h"

namespace lyrefit {

// The plant's tree as SVG. Each node of the deepest level with few enough nodes is a cell, and each
// node above is a row of cells. Empty without a tree.
std::string MapPicture(const PlantSummary& summary);

// Histogram of strings by performance factor as SVG, with a sentence. Empty if no factor is known.
std::string PerformancePicture(const PlantSummary& summary);

// The symbol of a zone as HTML, shown beside its colour; empty for an unknown zone.
std::string ZoneMark(const std::string& zone);

}  // namespace lyrefit
