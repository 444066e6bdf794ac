#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lyrefit/diagnose/candidate.h"
#include "lyrefit/diagnose/noise.h"

namespace lyrefit {

// Largest statistic of each testable candidate for each column of `draws`; result: draws x
// candidates. A null sample is the noise of that column after projection off the law's parameters.
// Rows not computed before a stop are 0.
Eigen::MatrixXf SimulateNullDistribution(const WeightedData& weighted, const Prepared& prepared,
                                         const Eigen::Ref<const Eigen::MatrixXf>& draws);

// Largest statistics as in SimulateNullDistribution, but with the noise re-estimated and the
// readings reweighted for each null sample. Fewer rows after a stop.
Eigen::MatrixXf SimulateRefits(const WeightedData& weighted, const Prepared& prepared,
                               const NoiseEstimator& estimator,
                               const Eigen::Ref<const Eigen::MatrixXf>& draws);

}  // namespace lyrefit
