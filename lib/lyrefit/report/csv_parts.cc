#include "lyrefit/report/csv_parts.h"

#include <fmt/format.h>

#include <cmath>

namespace lyrefit {

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string CsvField(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace lyrefit
