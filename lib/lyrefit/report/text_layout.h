// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

constexpr int kTextWidth = 100;  // columns of the terminal that text reports are laid out for

// `value` with this number of significant digits, including trailing zeros: "0.760788",
// "3.10685e-07". NaN is "-", an exact zero "0".
std::string Significant(double value, int digits);

// `value` in scientific notation: "9.860218779e-04"; "-" for NaN.
std::string Scientific(double value, int digits);

// "low .. high", with enough digits to show two or three digits of their difference.
std::string Range(double low, double high);

// "12 ms", "3.21 s"; "-" for NaN.
std::string Duration(double seconds);

// Wraps `text` at blanks to the width of the terminal. The first line begins with `first`, the
// others with as many blanks. Ends with a newline.
std::string Wrap(std::string_view first, std::string_view text);

// Number of terminal columns of a UTF-8 text.
std::size_t Columns(std::string_view text);

// A text as valid UTF-8: each byte that is not UTF-8 becomes U+FFFD. Names are read from files and
// may contain any bytes.
std::string Readable(std::string_view text);

}  // namespace lyrefit
