#pragma once

#include <optional>

#include "lyrefit/study/comparison.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

// What is known of a problem before its first run: names, model, objective, effects, parameters.
// `model` is that of subjects without their own.
ProblemResult DescribeProblem(const CompareCurve& subject, Model model,
                              const CompareOptions& options);

// Whether the fits of such a problem can be done: one cheap search finds whatever a fit would
// object to.
Expected<void> TryProblem(const CompareCurve& subject, const ProblemResult& problem,
                          const CompareOptions& options);

// One run of a compared on a problem, on one thread. Nothing where the observer stopped it.
// Errors: those of Fit() and FitFamily().
Expected<std::optional<RunOutcome>> RunOnce(const CompareCurve& subject,
                                            const ProblemResult& problem,
                                            const CompareOptions& options,
                                            const ComparedAlgorithm& compared, int run,
                                            const Observer& observer);

}  // namespace lyrefit
