#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// The lowest RMSE over all runs and stages of a problem.
struct BestFound {
  double rmse_A = kUnknown;
  std::vector<double> parameters;  // in the device's order
};

// Computes the reference of one problem. It tries to certify the optimum within the bounds that the
// runs search, which begin at a larger n than those asked for if Reference::steepest_n says so. Without
// a certificate the reference is the lowest RMSE of the runs and the proof. If the observer stops
// it, the reference is the best of the runs.
Reference FindReference(const CompareCurve& subject, Model model, const CompareOptions& options,
                        const BestFound& best, const Observer& observer = {});

}  // namespace lyrefit
