#include "lyrefit/curve/source_meter_trace.h"

#include "lyrefit/curve/number_text.h"
#include "lyrefit/curve/table_header.h"
#include "lyrefit/curve/table_lines.h"

namespace lyrefit {

std::string RowsOfTrace(std::string_view text) {
  constexpr std::size_t kNumbers = 5;
  constexpr std::size_t kResistance = 2;
  constexpr double kNotMeasured = 9.9e37;
  LineReader lines(text);
  std::string_view line;
  std::string_view more;
  if (!lines.NextContent(&line) || lines.NextContent(&more)) return "";
  const auto fields = SplitFields(line, ',');
  if (!fields || fields->size() < 2 * kNumbers || fields->size() % kNumbers != 0) return "";
  std::string rows;
  for (std::size_t i = 0; i < fields->size(); ++i) {
    const auto number = ParseNumber((*fields)[i]);
    const bool fits = number && (i % kNumbers != kResistance || *number >= kNotMeasured);
    if (!fits) return "";
    rows += (*fields)[i];
    rows += i % kNumbers + 1 == kNumbers ? '\n' : ',';
  }
  return rows;
}

}  // namespace lyrefit
