#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// One of the causes between which a further measurement is to decide.
struct PlannedCause {
  std::string id;
  double probability = kUnknown;  // of the right name where it is the true one
  double separation = kUnknown;   // from the nearest other, in deviations of the noise
  std::string nearest;            // that other
};

// A further measurement, and what it would tell.
struct PlannedMeasurement {
  std::string id;                 // "reverse_sweep"
  std::string title;              // what to do
  std::string taken;              // what is assumed of its readings
  double probability = kUnknown;  // of the right name, each cause as likely to be the true one
  std::vector<PlannedCause> causes;
};

// Which further measurement would tell the first cause from what these data cannot separate from
// it: simulated with the fitted causes, both fitted to old and new readings together.
struct Plan {
  std::vector<std::string> causes;               // the first cause and its equivalents; or none
  std::vector<PlannedMeasurement> measurements;  // the most telling first
  std::string sentence;
};

// A measurement that names the right cause less often tells nothing.
constexpr double kTelling = 0.8;

}  // namespace lyrefit
