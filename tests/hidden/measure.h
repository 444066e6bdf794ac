#pragma once

#include <vector>

#include "hidden/effects.h"
#include "hidden/plan.h"

namespace hidden {

// Currents as the instruments would show them without noise, outliers and steps of resolution.
std::vector<double> ExactCurrents(const Device& device, const Effects& effects, const Plan& plan);

}  // namespace hidden
