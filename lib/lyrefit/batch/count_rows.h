#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <variant>
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
  // Positions of columns; kNoColumn for a missing one.
  std::size_t status_, reason_, where_, zone_, cause_, about_;
  BatchCounts counts_;
};

// Position of a column; kNoColumn if there is none of the name.
inline constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();
std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const std::string& name);

// The cell of a row at a position; null if it is unknown, of another type, or not there.
template <class T>
const T* CellAt(const ResultRow& row, std::size_t place) {
  return place < row.cells.size() ? std::get_if<T>(&row.cells[place]) : nullptr;
}

// How many of all rows have each name, the most first. Without a name it is empty.
Section CountsSection(const std::string& heading, const std::string& what,
                      const std::map<std::string, std::int64_t>& counts, std::int64_t all);

}  // namespace lyrefit
