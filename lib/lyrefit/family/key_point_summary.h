#pragma once

#include <optional>
#include <vector>

#include "lyrefit/family/family_report.h"
#include "lyrefit/family/refine_family.h"

namespace lyrefit {

// Root mean square of the residuals of key points over all curves of a problem, in units of their
// errors.
double KeyPointRms(const JointProblem& problem, const JointPoint& point);

// Measured and fitted key points of every curve of a joint fit of key points, with the held-out
// powers of `tests`. `rows`: the curves of the set, with their parameters.
std::vector<FamilyCurve> WithKeyPoints(std::vector<FamilyCurve> rows, const RefinedFamily& refined,
                                       const std::vector<double>& shared, const FamilyTests& tests);

// Summarises the fitted curves of `rows`. `noise_A`: the residual standard deviation; `reference`:
// of the model at the reference.
KeyPointSummary SummariseKeyPoints(const std::vector<FamilyCurve>& rows,
                                   const RefinedFamily& refined, const FamilyOptions& options,
                                   double noise_A, const KeyPoints& reference);

// Devices that fit as well along the parameter that the key points determine least: one that is
// not identifiable, or the ideality if its interval is wider than a third of its value. None if
// there is no such parameter or the observer stopped it.
std::optional<EqualDevices> FindEqualDevices(const RefinedFamily& refined,
                                             const std::vector<Estimate>& estimates,
                                             const Observer& observer);

}  // namespace lyrefit
