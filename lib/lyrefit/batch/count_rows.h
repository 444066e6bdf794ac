#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

constexpr char kOthers[] = "other reasons";  // the key of those beyond kMostReasons

// Counts rows for the summary of a run, in constant memory.
class RowCounter {
 public:
  explicit RowCounter(const std::vector<ResultColumn>& columns);
  void Count(const ResultRow& row);
  const BatchCounts& counts() const { return counts_; }

 private:
  // Positions of columns; the number of columns for a missing one.
  std::size_t status_, reason_, where_, zone_, cause_, about_, flag_, plan_;
  BatchCounts counts_;
};

// Position of a column; the number of columns if there is none of the name.
std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const char* name);

}  // namespace lyrefit
