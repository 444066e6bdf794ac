#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/batch/batch.h"
#include "lyrefit/batch/result_row.h"

namespace lyrefit {

constexpr char kOthers[] = "other reasons";  // the key of those beyond kMostReasons

// Position of a column; kNoColumn if there is none of the name.
inline constexpr std::size_t kNoColumn = std::numeric_limits<std::size_t>::max();
std::size_t ColumnPlace(const std::vector<ResultColumn>& columns, const std::string& name);

// Reads cells of the rows of a table by the names of their columns.
class RowReader {
 public:
  RowReader() = default;  // of no columns
  explicit RowReader(const std::vector<ResultColumn>& columns);
  bool Has(std::string_view name) const { return places_.find(name) != places_.end(); }
  // The cell; of a cell that is unknown, of another type or not there: empty, NaN or false.
  std::string Text(const ResultRow& row, std::string_view name) const;
  double Number(const ResultRow& row, std::string_view name) const;
  bool Truth(const ResultRow& row, std::string_view name) const;

 private:
  // Null: there is none.
  const ResultCell* Find(const ResultRow& row, std::string_view name) const;

  std::map<std::string, std::size_t, std::less<>> places_;
};

// Counts rows for the summary of a run, in constant memory.
class RowCounter {
 public:
  explicit RowCounter(const std::vector<ResultColumn>& columns) : reader_(columns) {}
  void Count(const ResultRow& row);
  const BatchCounts& counts() const { return counts_; }

 private:
  RowReader reader_;
  BatchCounts counts_;
};

// How many of all rows have each name, the most first. Without a name it is empty.
Section CountsSection(const std::string& heading, const std::string& what,
                      const std::map<std::string, std::int64_t>& counts, std::int64_t all);

}  // namespace lyrefit
