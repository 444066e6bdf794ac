#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/curve/column.h"
#include "lyrefit/curve/sidecar.h"

namespace lyrefit {

// A current at zero volt as the head of a table states it: it tells the unit of a column that names
// none.
struct StatedCurrent {
  double value;     // in its own unit
  ColumnKind kind;  // a current or a density
  double factor;    // makes A or A/cm2 of it
  std::string source;
};

// What the lines before the header of a table state.
struct TableHead {
  Sidecar said;
  std::vector<Assumption> assumptions;  // what was taken from where
  std::vector<std::string> left;        // lines that hold a number nobody understood
  std::optional<StatedCurrent> short_circuit;
};

enum class HeadLine {
  kText,
  kComment  // only what it clearly states counts; the rest is a remark
};

// Takes what `line` clearly states: irradiance, cell temperature, number of cells, area,
// compliance, date, as "Irradiance (W/m2),912", "POA 912 W/m2", "Number of cells: 60". Of two
// statements on one thing the first counts.
void ReadHeadLine(std::string_view line, int number, HeadLine kind, TableHead* head);

// A value with its name, as JSON files state it. False if it was not understood.
bool TakeStatement(std::string_view label, double value, const std::string& source,
                   TableHead* head);

// The sentences about the head: what was taken, and some of the lines that were left.
std::vector<Assumption> HeadSentences(const TableHead& head);

}  // namespace lyrefit
