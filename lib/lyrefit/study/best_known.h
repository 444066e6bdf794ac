#pragma once

#include <string>

#include "lyrefit/study/comparison.h"
#include "lyrefit/study/reference.h"

namespace lyrefit {

// The lowest end of a long multistart of its own, which no compared's runs are part of:
// CompareOptions::multistart random points, each polished by itself to its end, and the hybrid
// after searches by DE, MLO and random points of 200 evaluations for each of these points.
struct BestKnown {
  BestFound best;
  std::string found_by;  // "random point 17"
  int points = 0;        // random points polished
  int visits = 0;        // of those that ended within 1e-6 (relative) of `best`
  bool interrupted = false;
};

// Nothing, with an RMSE of infinity, where no multistart is asked for. The same bits on any number
// of threads. Stopped by the observer, it is the best so far.
BestKnown FindBestKnown(const CompareCurve& subject, const ProblemResult& problem,
                        const CompareOptions& options, const Observer& observer = {});

// The reference of a problem without a certificate: the best of its runs and of the multistart.
Reference BestKnownReference(const BestFound& runs, const BestKnown& known);

}  // namespace lyrefit
