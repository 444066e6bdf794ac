#pragma once

#include <string>

#include "lyrefit/study/verdict.h"

namespace lyrefit {

// The result for a problem in one sentence without a full stop. Its text follows from the rule of
// verdict.h alone. Example:
// "strings_4: no search is needed: starts from the curve's shape alone hit 50 of 50 (8 ms); of
// the searches random reaches 48 of 50 with the best candidate's own polish from 1000
// evaluations (310 ms)"
std::string VerdictText(const ProblemSummary& summary);

// "default (50 of 50, 10 ms) is 12 times faster than pagmo:cmaes@1000 (45 of 50, 60 ms), run 2
// times". Empty if the default fit or all peers were not compared.
std::string PeerText(const ProblemSummary& summary);

}  // namespace lyrefit
