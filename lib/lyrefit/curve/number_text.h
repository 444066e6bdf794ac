#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// A decimal number in any locale: "1.5", "+1.5e-3", "-.5", with U+2212 as minus, blanks around it
// allowed; with `decimal_comma` also "1,5". Thousands may be set apart where a decimal part shows
// which separator is which: "8,892.6", with `decimal_comma` also "8.892,6". Empty for anything else
// and for numbers beyond double; "nan" and "inf" are numbers here, so that the caller can refuse
// them in its own words.
std::optional<double> ParseNumber(std::string_view text, bool decimal_comma = false);

// Half a unit of the last digit of a number as printed: 0.005 for "1.23", 5e-9 for "1.23E-06".
double HalfUnit(const std::string& printed);

// What instruments write for an overflow or for no value lies beyond this, what anybody measures
// below.
inline constexpr double kOverflowCode = 1e30;

// Whether a field stands for a reading that is missing: empty, NaN, a word such as "NA" or "ovf",
// or an overflow code.
bool IsMissingReading(std::string_view text, bool decimal_comma = false);

// A word that stands for a missing reading.
bool IsMissingWord(std::string_view text);

// `text` without the blanks and tabs around it.
std::string_view TrimBlanks(std::string_view text);

// `text` with the letters of ASCII in lower case.
std::string LowerCase(std::string_view text);

// `text` in quotes for a message, shortened, control characters replaced.
std::string Quoted(std::string_view text);

// Position (from 0) of the first byte that is not part of well-formed UTF-8.
std::optional<std::size_t> FirstInvalidUtf8(std::string_view text);

}  // namespace lyrefit
