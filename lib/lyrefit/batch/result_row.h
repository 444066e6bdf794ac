#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// What is written of each curve of many: one row, always, with the same columns.

// What a column holds: text, a number, a whole number, yes or no.
enum class CellType { kText, kNumber, kWhole, kTruth };

// A column of the results.
struct ResultColumn {
  std::string name;  // with its unit where it has one: "Rs_ohm"
  std::string unit;
  CellType type = CellType::kText;  // of all its cells
  std::string doc;                  // one line
};

// monostate: not known.
using ResultCell = std::variant<std::monostate, std::string, double, std::int64_t, bool>;

// What is written of one curve.
struct ResultRow {
  std::vector<ResultCell> cells;  // one a column
};

}  // namespace lyrefit
