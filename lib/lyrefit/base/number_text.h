// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Parses a decimal number, independent of the locale: "1.5", "+1.5e-3", "-.5", U+2212 as minus,
// blanks around it. `decimal_comma` also allows "1,5". Separators of thousands are allowed if a
// decimal part identifies them: "8,892.6", "8 892.6", with `decimal_comma` "8.892,6"; apostrophes
// and unbreakable blanks always. nullopt for any other text and for numbers beyond double. "nan"
// and "inf" are returned as numbers, so that the caller can report them.
std::optional<double> ParseNumber(std::string_view text, bool decimal_comma = false);

// " (numbers have a decimal point: 9.12)" for "9,12", in an error; empty for other texts.
std::string DecimalPointHint(std::string_view text);

// Half a unit of the last printed digit: 0.005 for "1.23", 5e-9 for "1.23E-06".
double HalfUnit(const std::string& printed);

// Magnitudes from here on are codes that instruments write for an overflow or a missing value.
// Readings are smaller.
inline constexpr double kOverflowCode = 1e30;

// Whether a field stands for a missing reading: empty, NaN, a word such as "NA" or "ovf", or an
// overflow code.
bool IsMissingReading(std::string_view text, bool decimal_comma = false);

// Whether the text is a word that stands for a missing reading.
bool IsMissingWord(std::string_view text);

// `text` without the blanks and tabs around it.
std::string_view TrimBlanks(std::string_view text);

// `text` with ASCII letters in lower case.
std::string LowerCase(std::string_view text);

// "1 cell", "3 cells"
std::string Plural(std::size_t count, const std::string& noun);

// `text` in quotes for a message; shortened, control characters replaced.
std::string Quoted(std::string_view text);

// Position (from 0) of the first byte that is not part of well-formed UTF-8; nullopt if there is
// none.
std::optional<std::size_t> FirstInvalidUtf8(std::string_view text);

}  // namespace lyrefit
