#pragma once

#include <string>

// What the CSV writers share.
namespace lyrefit {

// A field as RFC 4180 wants it: in quotes where it holds a comma, a quote or an end of line.
std::string CsvField(const std::string& text);

// The shortest text that reads back to the same number; empty for NaN and infinity.
std::string CsvField(double value);

}  // namespace lyrefit
