// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/fit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// One of the causes between which a further measurement decides.
struct PlannedCause {
  std::string id;
  double probability = kUnknown;  // of identifying it, if it is the true one
  double separation = kUnknown;   // from the nearest other cause, in noise deviations
  std::string nearest;            // id of that cause
};

// A further measurement and its expected result.
struct PlannedMeasurement {
  std::string id;                 // "reverse_sweep"
  std::string title;              // instruction
  std::string taken;              // assumptions about its readings
  double probability = kUnknown;  // of identifying the true cause, all causes equally probable
  std::vector<PlannedCause> causes;
};

// Further measurements that separate the first cause from its equivalents. Each fitted cause in
// turn is simulated as the true one, and all are fitted to old and new readings together.
struct Plan {
  std::vector<std::string> causes;               // first cause and equivalents; or empty
  std::vector<PlannedMeasurement> measurements;  // largest probability first
  std::string sentence;
};

// Smallest probability of identifying the true cause for which a measurement is recommended.
constexpr double kTelling = 0.8;

}  // namespace lyrefit
