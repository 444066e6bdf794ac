#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

// Sums rows up for the end of a run, in constant memory.
class RowCounter {
 public:
  // `summary` outlives it.
  RowCounter(const std::vector<ResultColumn>& columns, BatchSummary* summary);
  void Count(const ResultRow& row);

 private:
  // Columns; as many as there are: none.
  std::size_t status_, reason_, where_, zone_, cause_, about_, flag_;
  BatchSummary* const summary_;
};

// A sentence with every number, and every word in quotes that holds one, written as "N".
std::string WithoutNumbers(const std::string& sentence);

}  // namespace lyrefit
