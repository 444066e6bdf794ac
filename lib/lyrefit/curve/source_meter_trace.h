#pragma once

#include <string>
#include <string_view>

namespace lyrefit {

// The reply of a source meter whose whole buffer is one line of readings of five numbers each
// (voltage, current, resistance, time, status; a resistance that was not measured is 9.91e37), as a
// table of one reading a line. Empty if `text` is no such line.
std::string RowsOfTrace(std::string_view text);

}  // namespace lyrefit
