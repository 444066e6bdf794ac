#pragma once

#include <vector>

#include "lyrefit/study/best_known.h"
#include "lyrefit/study/comparison.h"
#include "lyrefit/study/journal.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

// The journal head: all inputs that a run of a comparison depends on. The number of runs is left
// out, so that a study can be resumed with more runs. The inputs must have been checked.
JournalLine CompareHead(const std::vector<CompareCurve>& curves,
                        const std::vector<ComparedAlgorithm>& algorithms,
                        const CompareOptions& options);

// The position of a run in its comparison.
struct RunPlace {
  int problem = 0;  // curves in the given order, each with all models
  int algorithm = 0;
  int run = 0;
};

JournalLine WriteRun(const RunPlace& place, const ProblemResult& problem,
                     const ComparedAlgorithm& compared, const CompareOptions& options,
                     const RunOutcome& outcome);

struct WrittenRun {
  RunPlace place;
  RunOutcome outcome;
};
Expected<WrittenRun> ReadRun(const Journal& journal, const Journal::Record& record);

// The record of a problem's multistart.
JournalLine WriteBestKnown(int problem, const BestKnown& known);
bool IsBestKnown(const Journal::Record& record);
struct WrittenBestKnown {
  int problem = 0;
  BestKnown known;
};
Expected<WrittenBestKnown> ReadBestKnown(const Journal& journal, const Journal::Record& record);

}  // namespace lyrefit
