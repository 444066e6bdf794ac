// Experimental: may change in a minor version (data/stable).
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The rows of the results of many curves: exactly one for each curve, all with the same columns.

// Type of a column's cells: text, number, integer, truth value.
enum class CellType { kText, kNumber, kWhole, kTruth };

// A column of the results.
struct ResultColumn {
  std::string name;  // with its unit where it has one: "Rs_ohm"
  std::string unit;
  CellType type = CellType::kText;  // of all its cells
  std::string doc;                  // description in one line
};

// monostate: unknown.
using ResultCell = std::variant<std::monostate, std::string, double, std::int64_t, bool>;

// The row of one curve.
struct ResultRow {
  std::vector<ResultCell> cells;  // one for each column
};

}  // namespace lyrefit
