// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// What is known of a measurement beside its readings that makes causes more or less common.
struct Circumstances {
  Setup setup = Setup::kUnknown;
  bool module = false;                   // more than one cell in series
  bool slow = false;                     // its times show that a sweep took half a second or more
  std::string technology = {};           // as stated; empty: unknown
  std::optional<double> age_years = {};  // of the device in the field
};

// A change of an effect's prior where more is known than that a sweep was taken in the field.
struct PriorFactor {
  bool (*holds)(const Circumstances& where);  // where it counts
  double factor;                              // of the prior; 0: the cause cannot be there
  const char* source;                         // on what it rests; of 0 why not, said in reports
};

// How often an effect is in a sweep at a size that matters, in sweeps of the field: probabilities in
// orders of magnitude. They and their factors order causes, and do not count sweeps: the evidence of
// a fault above the floors is usually larger by far, so that a factor of three changes few verdicts.
// Both are stated, with their source, or neither: 0 is not known, and counts like an effect of one's own.
struct EffectPrior {
  double in_cells = 0;                    // in a sweep of a cell
  double in_modules = 0;                  // ... of a module
  const char* source = "";                // on what the numbers rest
  std::vector<PriorFactor> factors = {};  // those that hold at once multiply
};

}  // namespace lyrefit
