#pragma once

#include <optional>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/family/refine_family.h"

namespace lyrefit {

// Error: parameters to test (`options.against`) whose number of cells differs from that of the set.
Expected<void> CheckAgainst(const FamilyProblem& family, const FamilyOptions& options);

// Tests the joint fit on whole curves at their stated conditions: on the held-out curves, or by
// cross-validation over folds. Tests the parameters of `options.against` on the same curves. Curves
// without stated conditions are not tested. `curves`: the rows of all curves of the set, with their
// individual fits. None if the observer stopped it.
std::optional<FamilyTests> TestFamily(const PreparedFamily& prepared, const RefinedFamily& refined,
                                      const std::vector<FamilyCurve>& curves,
                                      const Observer& observer);

}  // namespace lyrefit
