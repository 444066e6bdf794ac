#pragma once

#include "lyrefit/report/document.h"
#include "plant/plant_summary.h"

namespace lyrefit {

// The pictures of a plant's page, each with its caption and its numbers. Without the columns that it
// needs a picture has no panels.

// plant_groups.cc: the groups that lose most, by cause, in watts if they are known, else in
// strings.
block::Figure GroupsFigure(const PlantSummary& summary);

// plant_losses.cc: the energy that trends say is lost, by part, of the plant and of the groups that
// lose most.
block::Figure LossesFigure(const PlantLossSummary& losses);

// plant_map.cc: a cell for each group of the deepest level that has few enough; its colour is the largest
// shortfall of a string, or the share of strings that need work.
block::Figure MapFigure(const PlantSummary& summary);

// plant_figures.cc: histograms of the numbers that tell most.
block::Figure SpreadsFigure(const PlantSummary& summary);

// Histograms of the deviations from the strings of the same combiner.
block::Figure NeighboursFigure(const PlantSummary& summary);

// The curves of the worst strings.
block::Figure CurvesFigure(const PlantSummary& summary);

}  // namespace lyrefit
