#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/values.h"
#include "lyrefit/estimate/fit/error_spec.h"
#include "lyrefit/model/reading.h"

namespace lyrefit {

// The input of a diagnosis.
struct Measurement {
  Readings readings;
  DeviceNotes notes;  // of the first curve: noise stated in the file
  ValueFindings values;
  std::vector<double>
      stated_sigma;  // for each reading, in current scales; empty unless stated for all
  ErrorSpec errors;  // error model that is used

  // Whether the error model has a rough path along the sweeps beside the noise.
  bool has_path() const { return errors.kind != ErrorKind::kWhite; }
  // Whether the noise of the readings is used as stated, by the file or by sizes in the options.
  bool noise_is_stated() const {
    return errors.kind == ErrorKind::kStated || (has_path() && !stated_sigma.empty());
  }
  std::vector<std::string> warnings;  // metadata that the data contradict, in plain sentences
};

// Errors: those of MakeReadings, fewer than 7 readings.
Expected<Measurement> MakeMeasurement(const CurveSet& set);

}  // namespace lyrefit
