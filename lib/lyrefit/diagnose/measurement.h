#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/values.h"
#include "lyrefit/law/reading.h"

namespace lyrefit {

// What is diagnosed.
struct Measurement {
  Readings readings;
  DeviceNotes notes;  // of the first curve: noise stated beforehand
  ValueFindings values;
  bool has_path = false;  // a rough path along the sweeps is allowed for beside the noise
  std::vector<std::string> warnings;  // metadata that the data contradict, in plain sentences
};

// Errors: those of MakeReadings, fewer than 7 readings.
Expected<Measurement> MakeMeasurement(const CurveSet& set);

}  // namespace lyrefit
