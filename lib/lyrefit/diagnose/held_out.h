#pragma once

#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Which readings are left out together: whole sweeps (curves, and the ups and downs within them)
// where there are three or more, else short contiguous blocks spread over the sweep. One number a
// reading, 0 .. folds - 1.
std::vector<int> MakeFolds(const Readings& readings, int folds);

// Whether those are whole sweeps.
bool LeavesSweepsOut(const Readings& readings);

// Fills the held-out part of `gain` and of `trials`: in every fold the base model, each effect and
// the whole selection are fitted without it and tried on it.
void MeasureHeldOut(const Measurement& measurement, const SelectOptions& options,
                    const Selection& selection, int folds, int threads, Gain* gain,
                    std::vector<Trial>* trials);

}  // namespace lyrefit
