// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/compare_options.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

// A comparison input that is a single curve.
CompareCurve MakeSubject(IvCurve curve, BoundsSpec bounds);

// Runs every algorithm `runs` times on every curve with every model. All inputs are checked before
// the first run. Run r of all algorithms precedes run r + 1 of any. The observer receives stage
// "compare" at the beginning, after every run and at intervals; `iteration` counts the runs done.
// Errors: an unusable curve, options outside their ranges, bounds that do not fit a model, no
// algorithm, two algorithms with equal names, a journal of another study.
Expected<Comparison> Compare(const std::vector<CompareCurve>& curves,
                             const std::vector<ComparedAlgorithm>& algorithms,
                             const CompareOptions& options = {}, const Observer& observer = {});

}  // namespace lyrefit
