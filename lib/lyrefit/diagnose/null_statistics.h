#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/noise.h"

namespace lyrefit {

// The largest statistics of the testable candidates in each column of `draws`: null_statistics x candidates.
// A null is that noise less what the law absorbs. Zeros where a stop was asked for.
Eigen::MatrixXf SimulateNullDistribution(const WeightedData& weighted, const Prepared& prepared,
                              const Eigen::Ref<const Eigen::MatrixXf>& draws);

// The same where each null estimates its noise anew and is weighted with what it found. Fewer rows
// where a stop was asked for.
Eigen::MatrixXf SimulateRefits(const WeightedData& weighted, const Prepared& prepared,
                               const NoiseEstimator& estimator,
                               const Eigen::Ref<const Eigen::MatrixXf>& draws);

}  // namespace lyrefit
