#include "lyrefit/read/records.h"

#include <cmath>

#include "lyrefit/base/number_text.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {

void AddReading(std::string_view text, bool decimal_comma, int column, Record* list) {
  const auto number = ParseNumber(text, decimal_comma);
  if (number && std::fabs(*number) < kOverflowCode) return list->values.push_back(*number);
  const bool missing = IsMissingReading(text, decimal_comma) || (number && !std::isfinite(*number));
  // The number exceeds the range of a double, which is an overflow too.
  const bool overflow = !number && text.find_first_not_of("+-.0123456789eE") == std::string::npos &&
                        text.find_first_of("eE") != std::string::npos;
  const bool is_text = !missing && !overflow && text != "Infinity" && text != "-Infinity";
  if (!list->has_bad || (is_text && !list->bad_is_text)) {
    list->has_bad = true;
    list->bad = std::string(text);
    list->bad_at = list->values.size();
    list->bad_column = column;
    list->bad_is_text = is_text;
  }
  list->values.push_back(kUnknown);
}

}  // namespace lyrefit
