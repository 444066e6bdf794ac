#pragma once

#include "lyrefit/study/coverage.h"
#include "lyrefit/study/journal.h"

namespace lyrefit {

// The journal head: all inputs that a set of a coverage study and its fit depend on.
JournalLine CoverageHead(const CoverageOptions& options);

JournalLine WriteSet(int index, const CoverageSet& set);

struct WrittenSet {
  int index = 0;  // from 0
  CoverageSet set;
};
Expected<WrittenSet> ReadSet(const Journal& journal, const Journal::Record& record);

}  // namespace lyrefit
