#pragma once

#include <string>
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

// The best result of a long multistart that is independent of the compared runs. It polishes
// CompareOptions::multistart random points one by one. It also runs the hybrid fit after searches
// by DE, MLO and random points, with 200 evaluations for each of these points.
struct BestKnown {
  BestFound best;
  std::string found_by;  // "random point 17"
  int points = 0;        // number of random points polished
  int visits = 0;        // number of random points that ended within 1e-6 (relative) of `best`
  bool interrupted = false;
};

// Returns an infinite RMSE if CompareOptions::multistart is 0. The result has the same bits on any
// number of threads. If the observer stops it, the result is the best so far.
BestKnown FindBestKnown(const CompareCurve& subject, const ProblemResult& problem,
                        const CompareOptions& options, const Observer& observer = {});

// The reference of a problem without a certificate: the best of its runs and of the multistart.
Reference BestKnownReference(const BestFound& runs, const BestKnown& known);

}  // namespace lyrefit
