#pragma once

#include <string>

#include "lyrefit/curve/assumption.h"

namespace lyrefit {

// Says that a line of the head, "line 3 'Temp1: 45'", speaks of a temperature that was not used.
Assumption LeftTemperature(const std::string& line);

// Whether LeftTemperature made an assumption.
bool IsLeftTemperature(const Assumption& assumption);

}  // namespace lyrefit
