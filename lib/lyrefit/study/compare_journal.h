#pragma once

#include <vector>

#include "lyrefit/study/best_known.h"
#include "lyrefit/study/comparison.h"
#include "lyrefit/study/journal.h"
#include "lyrefit/study/summary.h"

namespace lyrefit {

// Everything that a run of a comparison depends on. How many runs there are is not among it: a
// study can be taken up with more. Everything must have been checked.
JournalLine CompareHead(const std::vector<CompareCurve>& curves,
                        const std::vector<ComparedAlgorithm>& algorithms, const CompareOptions& options);

// Where a run stands in its comparison.
struct RunPlace {
  int problem = 0;  // curves in the order given, each with all models
  int compared = 0;
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

// What a problem's multistart found, in a record of its own.
JournalLine WriteBestKnown(int problem, const BestKnown& known);
bool IsBestKnown(const Journal::Record& record);
struct WrittenBestKnown {
  int problem = 0;
  BestKnown known;
};
Expected<WrittenBestKnown> ReadBestKnown(const Journal& journal, const Journal::Record& record);

}  // namespace lyrefit
