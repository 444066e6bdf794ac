#pragma once

#include <memory>

#include "lyrefit/certify/cause_branch.h"

namespace lyrefit {

// The data with one more term for each theta.
MixtureData WithCause(MixtureData data, const std::shared_ptr<const CauseShape>& shape,
                      const std::vector<double>& thetas);

// Half the sum of squares of the best model with this Rs, u and theta; sets point->primal.
void Evaluate(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
              CausePoint* point);

// Descends in Rs, ln u and theta, the strengths following within their ranges (variable
// projection), and keeps within the region.
CausePoint Descend(const MixtureData& data, const std::shared_ptr<const CauseShape>& shape,
                   const CauseRegion& region, const CausePoint& start);

}  // namespace lyrefit
