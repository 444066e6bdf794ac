#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/checkpoint.h"

namespace lyrefit {

// The end of a run: the part files, all rows of which are there, become the results. They are read
// twice: what scatter is usual among neighbours is known when all were seen. Each result stands
// under its name when all of it is there; a process that is killed, or a full disk, leaves the part
// files and the results of before. So does an observer that stops it, which hears of
// stage "results"; `summary` is then marked as interrupted.
Expected<void> WriteResults(const std::vector<std::string>& parts, const std::string& folder,
                            const Observer& observer, const RowObserver& row_observer,
                            BatchSummary* summary);

// Counts what is in a part file, where there are no results of it alone.
Expected<void> CountRows(const std::string& part, BatchSummary* summary);

// The head of the results that are in the folder, nothing where there are none; an empty object
// where results of another kind have their names.
CheckpointHead ResultsHead(const std::string& folder);

// Whether the folder can be written and holds no results, unless they are to be replaced.
Expected<void> PrepareFolder(const std::string& folder, bool replace);

// What the results say of the run whose last part has this head.
CheckpointHead ResultsHeadOf(const CheckpointHead& head);

}  // namespace lyrefit
