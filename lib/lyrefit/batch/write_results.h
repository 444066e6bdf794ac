#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/checkpoint.h"

namespace lyrefit {

// Converts complete checkpoint files into results. With additions the files are read twice, since
// these learn from all rows first. A result file gets its name when it is
// complete. A killed process or a full disk leaves the checkpoint files and the earlier results. An
// observer that stops the call does so too, and there is no result then. The observer receives
// stage "results".
Expected<std::optional<BatchResults>> WriteResults(const std::vector<std::string>& parts,
                                                   const std::string& folder,
                                                   const BatchAdditions& additions,
                                                   const Observer& observer,
                                                   const RowObserver& row_observer);

// Counts the rows of one shard's checkpoint file, which has no results of its own.
Expected<BatchCounts> CountRows(const std::string& part);

// The head of the results in the folder; null if there are none. An empty object: files with the
// names of results exist that are not from lyrefit.
CheckpointHead ResultsHead(const std::string& folder);

// Checks that the folder is writable, and that it holds no results and no files of the additions,
// unless `replace`.
Expected<void> PrepareFolder(const std::string& folder, bool replace,
                             const BatchAdditions& additions);

// The part of a checkpoint's head that the results contain. `head` is that of the last shard.
CheckpointHead ResultsHeadOf(const CheckpointHead& head);

}  // namespace lyrefit
