#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

constexpr int kTextWidth = 100;  // columns of the terminal the text report is laid out for

// `value` with that many significant digits, trailing zeros kept: "0.760788", "3.10685e-07". NaN is
// "-", an exact zero "0".
std::string Significant(double value, int digits);

// "9.860218779e-04", "-" for NaN.
std::string Scientific(double value, int digits);

// "low .. high" with as many digits as tell both ends apart to two or three digits of their
// distance.
std::string Range(double low, double high);

// "12 ms", "3.21 s"; "-" for NaN.
std::string Duration(double seconds);

// Breaks `text` at blanks so that no line is longer than the terminal. The first line begins with
// `first`, the others with as many blanks. Ends with a newline.
std::string Wrap(std::string_view first, std::string_view text);

// Columns of a terminal that UTF-8 text takes.
std::size_t Columns(std::string_view text);

}  // namespace lyrefit
