#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/family/individual_fits.h"
#include "lyrefit/family/joint_fit.h"

// Stages of a family fit. Each is a value made from those before it.
namespace lyrefit {

// First stage: the law, the curves and their bounds. The set and the options must outlive it.
struct PreparedFamily {
  const CurveSet& set;
  const FamilyOptions& options;
  FamilyProblem family;
  std::vector<int> search_curves;  // positions in the set
};

// Checks the set and the options. Errors: those of FitFamily().
Expected<PreparedFamily> PrepareFamily(const CurveSet& set, const FamilyOptions& options);

// Individual fits of the curves, and the starts of the joint fit that those of the search curves
// give. Without FamilyOptions::individual_fits only the search curves are fitted.
struct CurvesAlone {
  std::vector<int> curves;  // positions in the set
  IndividualFits fits;      // of these curves
  std::vector<JointPoint> starts;
};
CurvesAlone FitCurvesAlone(const PreparedFamily& prepared, const Observer& observer);

// The joint fit on all fitted curves.
struct RefinedFamily {
  FamilyProblem family;  // with the selected weights, and integers fixed at their values
  JointProblem problem;
  JointEnd end;
  WeightChoice weights;
  double searched_key_points = kUnknown;   // KeyPointRms of the search's parameters
  RmsePair searched;                       // of the search's parameters, on all fitted curves
  std::optional<CandidateEnds> candidate;  // if requested (FamilyOptions::plain_polish)
  double seconds = 0;                      // of the joint fit, from all its starts
};

// Fits all curves jointly from the search's candidates and from the starts of the individual fits.
RefinedFamily RefineFamily(const PreparedFamily& prepared, const FamilySearchEnd& searched,
                           const std::vector<JointPoint>& individual_starts,
                           const Observer& observer);

}  // namespace lyrefit
