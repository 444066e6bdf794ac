#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "paper/sound_study.h"

// Tables of certificates that were checked against RMSE values reached by other means.
namespace lyrefit {

// The quantile of `values` at `share` (0 to 1), which is always one of the values. NaN if there are
// none.
double QuantileOf(std::vector<double> values, double share);

// Number of bounds, violations, certified shares and gaps, by objective and model.
block::Table BoundsTable(const SoundStudy& study);

// Certified shares and seconds, by objective and one further property.
block::Table NoiseTable(const SoundStudy& study);
block::Table PointsTable(const SoundStudy& study);
block::Table RangeTable(const SoundStudy& study);

// Results of planted optima, under the objective that each was planted for.
block::Table PlantedTable(const SoundStudy& study);

// The `count` certificates with the largest gaps for the model of their device.
block::Table WorstTable(const SoundStudy& study, int count);

int Violations(const SoundStudy& study);
int BoundsHeld(const SoundStudy& study);

}  // namespace lyrefit
