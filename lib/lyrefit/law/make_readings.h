#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// The curves of one device laid out reading by reading; `warnings` receives, in plain sentences,
// what of their metadata the data contradict. Errors: no usable curve, two devices (cell counts
// differ), numbers no device gives.
Expected<Readings> MakeReadings(const CurveSet& set, std::vector<std::string>* warnings);

// The times at which an irradiance step may lie, of one curve: between two of its readings.
void SetStepTimes(Readings* readings);

// The currents at which a range may end: between two readings of a sweep, a percent of the scale
// apart, none near the plateau or near zero.
void SetRangeCurrents(Readings* readings);

}  // namespace lyrefit
