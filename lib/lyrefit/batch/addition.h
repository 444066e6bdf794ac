#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/checkpoint.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// Adjacent rows whose ids have the same levels above the last.
struct RowGroup {
  std::vector<ResultRow> rows;
  // False: the ids have no level above, or more than kMostTogether rows have the same.
  bool together = false;
};

constexpr int kMostTogether = 1000;

// A file in the folder of the results.
struct ResultFile {
  std::string name;
  std::string text;
};

// What is known before the rows are read.
struct RowsInput {
  const CheckpointHead& head;                // of the last checkpoint file
  const std::vector<ResultColumn>& columns;  // of the checkpoint files
  const std::vector<std::string>& parts;     // the checkpoint files
  const std::vector<ResultColumn>& so_far;   // with those of the additions before
  const std::string& folder;                 // of the results and their pages
};

// What is added to the results of a run besides the rows of its task. The rows are read twice: all
// are learned from first, then cells are added. An object serves one run after another.
class BatchAddition {
 public:
  BatchAddition() = default;
  BatchAddition(const BatchAddition&) = delete;
  BatchAddition& operator=(const BatchAddition&) = delete;
  virtual ~BatchAddition() = default;

  // Before a run: what is needed of each curve, and the options of the addition, after the seed.
  virtual void AddToTask(BatchTaskType* /*task*/) const {}
  virtual void AddOptions(BatchJson* /*options*/) const {}
  // The run begins with these options, to which others may be added. Returns files that are kept
  // beside the checkpoint until there are results.
  virtual Expected<std::vector<ResultFile>> Begin(const BatchTaskType& /*task*/,
                                                  const std::string& /*folder*/,
                                                  BatchJson* /*options*/) const {
    return std::vector<ResultFile>();
  }
  // Names of all files that Files() may return.
  virtual std::vector<std::string> FileNames() const { return {}; }

  // The results of a run, or of shards, begin.
  virtual Expected<void> Open(const RowsInput& input) = 0;
  virtual std::vector<ResultColumn> Columns() const { return {}; }
  virtual void Learn(const RowGroup& /*group*/) {}
  virtual void EndLearning() {}  // after the last row
  // Adds the cells of Columns() to each row. The groups come in the same order again.
  virtual Expected<void> Add(RowGroup* /*group*/) { return {}; }
  // After the last row.
  virtual AddedReport Report() const { return {}; }
  virtual std::vector<ResultFile> Files() const { return {}; }
  virtual void AddToSchema(BatchJson* /*schema*/) const {}
};

// "site/inv/comb" for "site/inv/comb/string"; empty if there is no level above.
std::string ParentOf(const std::string& id);

}  // namespace lyrefit
