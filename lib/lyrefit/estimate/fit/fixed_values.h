#pragma once

#include <map>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/model/device.h"

namespace lyrefit {

// Value of each parameter that the user fixed, NaN for the others. Keys are symbols or names; "Is"
// and "n" stand for every diode.
Expected<std::vector<double>> FixedValues(const std::map<std::string, double>& fixed,
                                          const Device& device);

}  // namespace lyrefit
