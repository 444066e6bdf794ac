#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace lyrefit {

// What is written of each curve of many: one row, always, with the same columns.

enum class CellType { kText, kNumber, kWhole, kTruth };

struct ResultColumn {
  std::string name;  // with its unit where it has one: "Rs_ohm"
  std::string unit;
  CellType type = CellType::kText;
  std::string doc;  // one line
};

// monostate: not known.
using ResultCell = std::variant<std::monostate, std::string, double, std::int64_t, bool>;

struct ResultRow {
  std::vector<ResultCell> cells;  // one a column
};

}  // namespace lyrefit
