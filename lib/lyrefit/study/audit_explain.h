#pragma once

#include <optional>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

struct AuditSearch {
  std::vector<AuditExplanation> explanations;  // all with as few changes as any, nearest first
  std::optional<AuditExplanation> nearest;     // where there are none; see AuditFinding
};

// Looks for the fewest changes, three at most, under which a row's claim reproduces.
//
// With thousands of readings at hand some come near any claim by accident. How many is judged from
// the readings themselves: if N of those tried so far lie within a factor of exp(1/2) of the claim,
// then N x 2 x tolerance / claim of them are to be expected within the tolerance, and as many more
// for every further set of constants that was open and gives another figure. Above 0.01 a match
// explains nothing.
AuditSearch Explain(const AuditSubject& subject);

}  // namespace lyrefit
