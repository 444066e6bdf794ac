#pragma once

#include <string>
#include <vector>

#include "lyrefit/family/family_members.h"

namespace lyrefit {

// A family fit before its search: law, curves, bounds and fixed values.
struct FamilyProblem {
  Translation translation;
  FamilyMembers curves;
  // Bounds and fixed values of the shared parameters, then of both sensor errors. NaN in `fixed`:
  // free.
  std::vector<ParameterBounds> bounds;
  std::vector<double> fixed;
  std::vector<std::string> notes;  // parameters fixed by default, with reasons
  int free_parameters = 0;         // number of free shared parameters
};

// Builds the problem. Errors: fewer than two light curves, unknown names, empty or invalid ranges,
// a sensor offset that the conditions of the set cannot determine.
Expected<FamilyProblem> MakeFamilyProblem(const CurveSet& set, const FamilyOptions& options);

// Builds the joint problem on the given curves (positions in the set).
JointProblem JointProblemOn(const FamilyProblem& family, const FamilyOptions& options,
                            const std::vector<int>& curves);

}  // namespace lyrefit
