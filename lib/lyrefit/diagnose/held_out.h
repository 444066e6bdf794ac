#pragma once

#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Assigns readings to folds that are left out together. With three or more sweeps (curves, or up
// and down sweeps within them) a fold holds whole sweeps, else short contiguous blocks spread over
// the sweep. Returns one fold per reading, 0 .. folds - 1.
std::vector<int> MakeFolds(const Readings& readings, int folds);

// Whether MakeFolds leaves out whole sweeps.
bool LeavesSweepsOut(const Readings& readings);

// Fills the held-out fields of `gain` and `trials`. For every fold, the base model, each effect and
// the whole selection are fitted without the fold and evaluated on it.
void MeasureHeldOut(const Measurement& measurement, const SelectOptions& options,
                    const Selection& selection, int folds, int threads, Gain* gain,
                    std::vector<Trial>* trials);

}  // namespace lyrefit
