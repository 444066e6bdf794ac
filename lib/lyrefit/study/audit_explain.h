#pragma once

#include <optional>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

struct AuditSearch {
  std::vector<AuditExplanation> explanations;  // all with the fewest changes, nearest first
  std::optional<AuditExplanation> nearest;     // if there are no explanations; see AuditFinding
};

// Searches for the fewest changes, at most three, under which a row's claim reproduces.
//
// Thousands of readings are tried, so some match any claim by accident. The expected number of
// accidental matches is estimated from the readings themselves. Let N of the readings tried so far
// lie within a factor of exp(1/2) of the claim. Then N x 2 x tolerance / claim of them are expected
// within the tolerance. The number is added once more for every other open set of constants that
// gives another RMSE. A match with an expectation above 0.01 is not an explanation.
AuditSearch Explain(const AuditSubject& subject);

}  // namespace lyrefit
