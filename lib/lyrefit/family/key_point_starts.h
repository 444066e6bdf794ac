#pragma once

#include <vector>

#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

// Starts of a joint fit of key points: for idealities from 0.8 to 2 the curves that pass through
// Isc, Voc and the maximum power point of the brightest of these conditions that states all
// (key_point_curve.h), translated to the reference with usual coefficients.
std::vector<JointPoint> KeyPointStarts(const FamilyProblem& family, const std::vector<int>& curves);

}  // namespace lyrefit
