// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A size with its 95 % interval.
struct Sized {
  double value = kUnknown;  // in the unit of the field
  double low_95 = kUnknown;
  double high_95 = kUnknown;
};

// A fitted parameter of an effect.
struct CauseParameter {
  std::string symbol;
  std::string name;  // name in code and JSON
  std::string unit;
  double value = kUnknown;  // in `unit`
  double low_95 = kUnknown;
  double high_95 = kUnknown;
  bool at_bound = false;
};

// A hypothesis that could stand in the place of a cause.
struct Alternative {
  std::string id;  // of an effect; "none": no cause; "unknown_structure": none of the known
  std::string title;
  double probability = kUnknown;  // those of a cause and of all its alternatives add up to 1
};

// What is wrong, with how large, how sure, what it costs and what to do: an effect that explains a
// deviation of the data from the base model, a parameter of the device out of its range, the onset of
// a trend. What does not apply is empty or unknown.
struct Cause {
  std::string id;      // of the finding, which may have several mechanisms
  std::string effect;  // id of the effect that is fitted: its most probable mechanism
  std::string title;
  std::string sentence;                   // for a technician, with size
  std::vector<std::string> in_words;      // meaning here: light in %, heat of a hot cell in W
  Sized current_effect;                   // on the curve, root mean square, fraction of Isc
  Sized power_effect;                     // relative error of Pmax of a model without the effect
  Sized recoverable_power_W;              // additional Pmax of the device without the effect
  bool at_least = false;                  // that power is a lower limit: only low_95 is known
  double probability = kUnknown;          // of the finding, against the alternatives
  std::vector<Alternative> alternatives;  // above 0.5 %, most probable first
  std::vector<Alternative> mechanisms;    // effects of the same finding, likewise; empty: only one
  std::string group;                      // "device", "wiring", "sweep", "instrument", "unknown"
  std::string action;                     // the next thing to do about it
  std::string fact_sheet;                 // of IEA-PVPS T13-30:2025; may be empty
  std::vector<std::string>
      equivalents;  // ids that these data cannot separate from it, with its mechanisms
  std::vector<std::string> separate_by;  // measurements that would separate them
  std::vector<CauseParameter> strength;  // its parameters with intervals
  std::string evidence;                  // "fit" or "values"
  std::string acts;                      // region of the curve in which it acts, as text
  std::vector<int> points;               // where it acts most: positions in Diagnosis::points
};

}  // namespace lyrefit
