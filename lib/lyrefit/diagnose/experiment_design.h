#pragma once

#include <cstdint>

#include "lyrefit/diagnose/joint_fit.h"
#include "lyrefit/diagnose/plan.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// What a plan decides between.
struct PlanCandidate {
  const Effect* effect = nullptr;  // the last of its law
  LawFit fit;
  double charge = 0;  // on the sum of squares, for its freedom
  // From where it is fitted to more readings: where it stands and, where these are few, other
  // settings of what is searched.
  std::vector<std::vector<double>> starts;
};
PlanCandidate MakeCandidate(const Readings& readings, const LawFit& fit, double charge);

// The first cause that has equivalents, and these; none where every cause stands alone.
std::vector<PlanCandidate> PlanCandidates(const Selection& selection);

// Factor on the deviations of the weighted data: its noise as the extended model has it.
double DeviationOf(const Selection& selection);

// How surely a further measurement names each candidate, were it the true one.
std::vector<PlannedCause> Foresee(const WeightedData& weighted, double deviation, const FollowUp& follow_up,
                                  const std::vector<PlanCandidate>& candidates, std::uint64_t seed);

// `threads`: 0 for all cores.
Plan MakePlan(const Selection& selection, std::uint64_t seed, int threads);

}  // namespace lyrefit
