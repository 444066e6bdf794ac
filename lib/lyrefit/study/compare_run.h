#pragma once

#include <optional>
#include <vector>

#include "lyrefit/study/comparison.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

// The description of a problem before its first run: names, model, objective, effects, parameters.
// `model` applies to inputs without a model of their own.
ProblemResult DescribeProblem(const CompareCurve& subject, Model model,
                              const CompareOptions& options);

// Checks that a problem can be fitted. It runs one cheap search, which returns every error that a
// fit would return.
Expected<void> TryProblem(const CompareCurve& subject, const ProblemResult& problem,
                          const CompareOptions& options);

// One run of an algorithm on a problem, on one thread. Empty if the observer stopped it. Errors:
// those of Fit() and FitFamily().
Expected<std::optional<RunOutcome>> RunOnce(const CompareCurve& subject,
                                            const ProblemResult& problem,
                                            const CompareOptions& options,
                                            const ComparedAlgorithm& compared, int run,
                                            const Observer& observer);

// Checks a comparison without reading its curves. Errors: nothing to compare, missing or equal
// names, options outside their ranges.
Expected<void> CheckComparison(const std::vector<CompareCurve>& curves,
                               const std::vector<ComparedAlgorithm>& algorithms,
                               const CompareOptions& options);

}  // namespace lyrefit
