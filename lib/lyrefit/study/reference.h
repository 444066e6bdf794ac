#pragma once

#include <vector>

#include "lyrefit/study/comparison.h"

namespace lyrefit {

// The lowest RMSE that any run of a problem came to, searched or polished.
struct BestFound {
  double rmse_A = kUnknown;
  std::vector<double> parameters;  // in the device's order
};

// What the runs of one problem are measured against. Stopped by the observer, it is the best of the
// runs.
Reference FindReference(const CompareCurve& subject, Model model, const CompareOptions& options,
                        const BestFound& best, const Observer& observer = {});

}  // namespace lyrefit
