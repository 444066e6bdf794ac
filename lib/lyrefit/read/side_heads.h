#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/table_columns.h"
#include "lyrefit/read/table_head.h"

namespace lyrefit {

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
