#pragma once

#include <vector>

#include "lyrefit/family/family_problem.h"

namespace lyrefit {

// Puts the effects of the options beside the diodes: translation, bounds, and of every curve that
// is not left out its measurement. Errors: a law, an objective or unknowns of single curves that do
// not go with effects, and those of Extend.
Expected<void> AddFamilyEffects(const CurveSet& set, const FamilyOptions& options,
                                FamilyProblem* family);

// Starts of a joint fit with effects: the best candidate and further elites as they are, then the best
// fit that leaves the effects at what is usual, found from all `starts`, with each of their probes
// beside it, the best by their error on the curves of the search.
std::vector<JointPoint> FamilyEffectStarts(const FamilyProblem& family,
                                           const FamilyOptions& options,
                                           const std::vector<int>& search_curves,
                                           const std::vector<JointPoint>& elites,
                                           std::vector<JointPoint> starts,
                                           const Observer& observer);

// The starts of a joint fit: of `starts`, the first so many of which are the search's elites, those
// that the options let in; with effects as FamilyEffectStarts has them.
std::vector<JointPoint> ChooseStarts(const FamilyProblem& family, const FamilyOptions& options,
                                     const std::vector<int>& search_curves,
                                     std::vector<JointPoint> starts, std::ptrdiff_t elites,
                                     const Observer& observer);

// A joint fit as it is judged: with the effects' parameters in the units of reports, and beside
// other optima where intervals are asked for. Without effects as it is.
struct QuotedFit {
  FamilyProblem family;
  JointProblem problem;
  JointEnd end;
  std::vector<FitPoint> local_optima;  // other optima, which the data allow as well
};
QuotedFit Quote(const FamilyProblem& family, const FamilyOptions& options,
                const JointProblem& problem, const JointEnd& end, const Observer& observer);

}  // namespace lyrefit
