#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/model/effect.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// The curves of one device as Readings. `warnings` receives a sentence for each statement in the
// metadata that the data contradict. Errors: no usable curve, different cell counts (two devices),
// values beyond any device.
Expected<Readings> MakeReadings(const CurveSet& set, std::vector<std::string>* warnings);

// Sets traits.step_times: the times, of one curve, at which an irradiance step may lie, between two
// readings.
void SetStepTimes(Readings* readings);

// Sets traits.range_currents: the currents at which a measuring range may end, between two readings
// of a sweep. They are at least 1 % of the scale apart, none near the plateau or zero.
void SetRangeCurrents(Readings* readings);

// Readings in blocks of eight. Readings at the same irradiance and temperature form their own block
// if they fill at least half of one.
std::vector<ReadingBlock> BlocksOf(const Readings& readings);

}  // namespace lyrefit
