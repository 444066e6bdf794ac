#pragma once

#include <string>
#include <string_view>

namespace lyrefit {

// Converts the reply of a source meter to a table with one reading a line. The reply is the whole
// buffer in one line, five numbers a reading: voltage, current, resistance, time, status. A
// resistance that was not measured is 9.91e37. Empty if `text` has another form.
std::string RowsOfTrace(std::string_view text);

}  // namespace lyrefit
