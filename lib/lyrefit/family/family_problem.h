#pragma once

#include <string>
#include <vector>

#include "lyrefit/family/family_members.h"

namespace lyrefit {

// A family fit before the first number is crunched.
struct FamilyProblem {
  Translation translation;
  FamilyMembers curves;
  // Of the shared parameters and of both sensor errors behind them; NaN in `fixed`: free.
  std::vector<ParameterBounds> bounds;
  std::vector<double> fixed;
  std::vector<std::string> notes;  // what is held, and why
  int free_parameters = 0;         // shared
};

// Errors: fewer than two light curves, unknown names, ranges that make no sense, an offset that the
// conditions of the set cannot show.
Expected<FamilyProblem> MakeFamilyProblem(const CurveSet& set, const FamilyOptions& options);

// The joint problem on some of the curves.
JointProblem JointProblemOn(const FamilyProblem& family, const FamilyOptions& options,
                            const std::vector<int>& curves);

}  // namespace lyrefit
