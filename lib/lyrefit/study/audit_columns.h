#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"

namespace lyrefit {

// Every column a table of published parameters may have, for messages.
extern const char* const kAuditColumnNames;

// A column of a current, a resistance or an n.
struct QuantityColumn {
  int field = 0;      // position in the line
  double factor = 1;  // its unit in ampere or ohm
};

// Which column is what.
struct AuditColumns {
  char delimiter = ',';
  std::size_t fields = 0;            // in every line
  std::map<std::string, int> words;  // "device" -> position in the line
  // "is1" -> its columns, one a unit. Names are in lower case.
  std::map<std::string, std::vector<QuantityColumn>> quantities;
};

// Understands the header, line `number` of the file at `path`. Errors: an unknown, repeated or
// missing column.
Expected<AuditColumns> ReadAuditColumns(std::string_view line, const std::string& path, int number);

// `text` with A to Z made small.
std::string AsciiLower(std::string_view text);

}  // namespace lyrefit
