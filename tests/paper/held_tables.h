#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "paper/sound_study.h"

// Tables of certificates that were held against what is known.
namespace lyrefit {

// The value below which a share of `values` lies, by rank; NaN of none.
double QuantileOf(std::vector<double> values, double share);

// Bounds, violations, shares certified and gaps, by objective and model.
block::Table BoundsTable(const SoundStudy& study);

// Shares certified and seconds by objective and one more property.
block::Table NoiseTable(const SoundStudy& study);
block::Table PointsTable(const SoundStudy& study);
block::Table RangeTable(const SoundStudy& study);

// What became of the planted optima under the objective that they were planted for.
block::Table PlantedTable(const SoundStudy& study);

// The certificates that took longest and those with the widest gaps of their own device's model.
block::Table WorstTable(const SoundStudy& study, int count);

int Violations(const SoundStudy& study);
int BoundsHeld(const SoundStudy& study);

}  // namespace lyrefit
