#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Every column that a table of published parameters may have, as text for error messages.
extern const char* const kAuditColumnNames;

// A column that holds a current, a resistance or an ideality factor n.
struct QuantityColumn {
  int field = 0;      // position in the line, from 0
  double factor = 1;  // the column's unit in ampere or ohm; 1 for n
};

// The meaning of each column.
struct AuditColumns {
  char delimiter = ',';
  std::size_t fields = 0;  // number of fields in every line
  // Column name -> position in the line, for example "device" -> 1.
  std::map<std::string, int> words;
  // Quantity in lower case ("is1") -> its columns, one for each unit.
  std::map<std::string, std::vector<QuantityColumn>> quantities;
};

// Parses the header, which is line `number` of the file at `path`. Errors: an unknown, repeated or
// missing column.
Expected<AuditColumns> ReadAuditColumns(std::string_view line, const std::string& path, int number);

}  // namespace lyrefit
