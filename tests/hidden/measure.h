#pragma once

#include <vector>

#include "hidden/effects.h"
#include "hidden/plan.h"

namespace hidden {

// Currents that the instruments show without noise, outliers and resolution, in A.
std::vector<double> ExactCurrents(const Device& device, const Effects& effects, const Plan& plan);

}  // namespace hidden
