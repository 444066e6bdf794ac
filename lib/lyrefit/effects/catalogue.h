#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/law/effect.h"

namespace LYREFIT_PUBLIC lyrefit {

// Every effect lyrefit knows, in the order of reports. To add one: a file effects/<id>.cc with a
// function that makes it, and its line in catalogue_entries.h.
const std::vector<const Effect*>& Catalogue();

// Values of clip's limits where there is none.
constexpr double kNoUpperLimit = 1.5;
constexpr double kNoLowerLimit = -50;

// The effect with this id, nullptr if there is none.
const Effect* FindEffect(const std::string& id);

// What no current-voltage data can tell from the parameters it biases: never named as a cause.
struct Inseparable {
  const char* id;      // "lead_resistance"
  const char* biases;  // "Rs"
  const char* sentence;
  const char* separate_by;
  bool (*applies)(const DataTraits&);  // whether data of this kind leave it open
};
const std::vector<Inseparable>& InseparableCauses();

}  // namespace lyrefit
