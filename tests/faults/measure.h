#pragma once

#include <vector>

#include "faults/effects.h"
#include "faults/plan.h"

namespace faults {

// Currents that the instruments show without noise, outliers and resolution, in A.
std::vector<double> ExactCurrents(const Device& device, const Effects& effects, const Plan& plan);

}  // namespace faults
