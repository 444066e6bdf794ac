#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "lyrefit/study/verdict.h"

namespace lyrefit {

// What the figures of a problem say, in one sentence without a full stop; no word of it stands
// anywhere but in the rule:
// "strings_4: no search is needed: starts from the curve's shape alone hit 50 of 50 (8 ms); of the
// searches random reaches 48 of 50 with the best candidate's own polish from 1000 evaluations (310 ms)"
std::string VerdictText(const ProblemSummary& pool);

// A line a problem: hits and median time of a run of the starts from the shape alone, of the
// default fit, of the search that was enough (else of the one with the most hits), of random points
// likewise, and of the peer that is sure to hit the soonest.
block::Table VerdictTable(const std::vector<ProblemSummary>& pools);

// "default (50 of 50, 10 ms) is 12 times faster than pagmo:cmaes@1000 (45 of 50, 60 ms), run 2
// times"; empty where the default fit or any peer was no compared.
std::string PeerText(const ProblemSummary& pool);

}  // namespace lyrefit
