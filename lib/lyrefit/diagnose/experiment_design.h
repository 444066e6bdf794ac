#pragma once

#include <cstdint>

#include "lyrefit/diagnose/joint_fit.h"
#include "lyrefit/diagnose/plan.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// One of the causes between which a plan decides.
struct PlanCandidate {
  const Effect* effect = nullptr;  // one of its law
  LawFit fit;
  double charge = 0;  // penalty on the sum of squares, for its freedom
  // Starts of fits to additional readings: the present parameters and, if there are at most eight,
  // the other probe values of searched parameters.
  std::vector<std::vector<double>> starts;
};
PlanCandidate MakeCandidate(const Readings& readings, const FittedCandidate& fitted);

// The first cause that has equivalents, and these. Empty if no cause has any.
std::vector<PlanCandidate> PlanCandidates(const Selection& selection);

// Factor from the sigmas of the weighted data to the residual deviation of the extended model.
double DeviationOf(const Selection& selection);

// Probability that a further measurement identifies each candidate, if that candidate is the true
// one.
std::vector<PlannedCause> Foresee(const WeightedData& weighted, double deviation,
                                  const FollowUp& follow_up,
                                  const std::vector<PlanCandidate>& candidates, std::uint64_t seed);

// `threads`: 0 for all cores.
Plan MakePlan(const Selection& selection, std::uint64_t seed, int threads);

}  // namespace lyrefit
