#pragma once

#include <memory>

#include "lyrefit/certify/cause_branch.h"

namespace lyrefit {

// Adds one term of `shape` to the data for each theta. A null shape leaves the data unchanged.
MixtureData WithCause(MixtureData data, const std::shared_ptr<const CauseShape>& shape,
                      const std::vector<double>& thetas);

// Sets point->primal to half the sum of squares of the best model with the point's Rs, u and theta.
void Evaluate(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
              CausePoint* point);

// Minimises over Rs, ln u and theta within the region. The strengths are eliminated within their
// ranges (variable projection). Returns the lower of the result and `start`.
CausePoint Descend(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                   const CauseRegion& region, const CausePoint& start);

}  // namespace lyrefit
