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

// Adds the effects of the options to the diodes of a family problem: extends the translation and
// the bounds, and gives every curve that is not left out its extended device. Errors: a law, an
// objective or per-curve unknowns that cannot be combined with effects, and those of
// ExtendTranslation.
Expected<void> AddFamilyEffects(const CurveSet& set, const FamilyOptions& options,
                                FamilyProblem* family);

// Returns the starts of a joint fit with effects. The first are the best candidate and further
// elites of the search. The others take the best fit without effects from all `starts` (effects
// fixed at their usual values) and combine it with the points of EffectStarts. Of these only the
// best by RMSE on the search curves are kept.
std::vector<JointPoint> FamilyEffectStarts(const FamilyProblem& family,
                                           const FamilyOptions& options,
                                           const std::vector<int>& search_curves,
                                           const std::vector<JointPoint>& elites,
                                           std::vector<JointPoint> starts,
                                           const Observer& observer);

// Selects the starts of a joint fit by `options.starts`. The first `elites` of `starts` are the
// search's elites. With effects the selection passes through FamilyEffectStarts.
std::vector<JointPoint> ChooseStarts(const FamilyProblem& family, const FamilyOptions& options,
                                     const std::vector<int>& search_curves,
                                     std::vector<JointPoint> starts, std::ptrdiff_t elites,
                                     const Observer& observer);

}  // namespace lyrefit
