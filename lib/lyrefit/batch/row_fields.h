#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// A row taken apart, whatever it was written in: what stands in it under which name.

struct RowScalar {
  std::string name;
  std::string text;      // without quotes; of a number as written
  bool is_text = false;  // said to be text, not a number
  int column = 0;        // in its line, from 1
};

// A list of readings.
struct RowList {
  std::string name;
  std::vector<double> values;  // NaN where one is missing
  int column = 0;
  std::string bad;  // the first that is no finite number, as written
  std::size_t bad_at = 0;
  int bad_column = 0;         // 0: there is none
  std::int64_t bad_line = 0;  // where each reading has a line of its own
  bool bad_is_text = false;   // it cannot be left out as missing
};

struct RowFields {
  std::vector<RowScalar> scalars;
  std::vector<RowList> lists;
  std::vector<std::string> assumptions;  // what reading it before had to assume
  bool nested = false;                   // holds something that is neither
};

// Takes one item of a list: a number, or one that is missing or no number.
void AddReading(std::string_view text, bool decimal_comma, int column, RowList* list);

}  // namespace lyrefit
