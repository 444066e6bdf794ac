#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/compare_options.h"
#include "lyrefit/study/comparison.h"
#include "lyrefit/study/landscape.h"

namespace LYREFIT_PUBLIC lyrefit {

// A curve on its own.
CompareCurve MakeSubject(IvCurve curve, BoundsSpec bounds);

// One of the made devices of a problem.
CompareCurve SubjectOf(LandscapeCase made);

// Runs every compared `runs` times on every curve with every model. Everything is checked before
// the first run. Run r of all algorithms comes before run r + 1 of any. The observer hears of stage
// "compare" at the beginning, after every run (iteration: runs done of those planned) and now and
// then in between. Errors: an unusable curve, options outside their ranges, bounds that do not fit
// a model, no or two equal compared names, a journal of another study.
Expected<Comparison> Compare(const std::vector<CompareCurve>& curves,
                             const std::vector<ComparedAlgorithm>& algorithms,
                             const CompareOptions& options = {}, const Observer& observer = {});

}  // namespace lyrefit
