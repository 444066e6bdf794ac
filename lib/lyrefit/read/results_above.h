#pragma once

#include <string_view>
#include <vector>

#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_head.h"
#include "lyrefit/read/table_header.h"

namespace lyrefit {

// A table of results above the readings, one row a sweep. Its last column names the sweeps.
struct ResultsAbove {
  Fields names;
  std::vector<Fields> rows;
};

// Records `line` if it is the header or a row of a table of results. Values that are equal in all
// rows, such as an area, count as statements of the head.
// Returns whether it is one of them.
bool TakeResults(std::string_view line, int number, ResultsAbove* results, TableHead* head);

// Interprets `line` as a header whose currents are not named: a voltage, then a number for each row
// of the results. The rows then name the currents and their unit. The delimiter is 0 if `line` is
// something else.
TableLine HeaderBelowResults(const ResultsAbove& results, std::string_view line,
                             std::string_view next_line);

// Adds names that stand above groups of columns, "Pixel 1,,Pixel 2,", to the labels of a header
// whose groups have equal labels.
void TakeGroupNames(std::string_view above, TableLine* header);

// A line above the header that may state something.
struct LineOfHead {
  std::string_view text;
  int number;
  HeadLine kind;
};

// Where heads stand beside each other, one above each pair of columns: the head of the measurement
// whose voltage and current are `own`. A line of such heads repeats its label above every pair. What a
// label without a number says of the light counts too: the dark, or a room's light, of which no
// irradiance is known. Results are those of `all`. False if the heads do not stand so.
bool ReadOwnHead(const std::vector<LineOfHead>& lines, char delimiter,
                 const std::vector<Channel>& channels, const ColumnPair& own, TableHead* all);

}  // namespace lyrefit
