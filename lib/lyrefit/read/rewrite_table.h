#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/text_encoding.h"

namespace lyrefit {

// A text in which every reading has its own line. Three layouts are rewritten, and `remark` says so;
// other text is returned unchanged:
//   - the reply of a source meter: the whole buffer in one line, five numbers a reading (voltage,
//     current, resistance, time, status); a resistance that was not measured is 9.91e37,
//   - the scan of an inverter: rows of currents without voltages, below lines that state the first
//     voltage and the interval ("Start_V", "Interval_V"),
//   - a measurement a line with all pixels in it: ten settings, a field that begins with
//     "hysteresis$", results, then the current densities and the voltages of each pixel.
// The scan tells the setup of the measurement, so does the line of pixels. Lines of the second layout
// keep their numbers.
DecodedText RewriteTable(DecodedText text);

// The scan of an inverter as it stands in its registers, whole numbers of 16 bits: pairs of voltage
// and current, or a block of voltages and blocks of the currents of its strings.
struct RegisterScan {
  std::vector<double> voltages;               // as written
  std::vector<std::vector<double>> currents;  // of each string
};

// Takes a list of registers apart; nullopt if it is no scan: the voltages must rise or fall all the
// way, and the currents must be higher at the low voltages. Both count up to the zeros at the end.
std::optional<RegisterScan> AsRegisterScan(const std::vector<double>& registers);

// The rows of a dump: lines of `address,value`, or a list of whole or hexadecimal numbers. Scales
// come from the lines above ("voltage 0.1 V, current 0.01 A"). Empty if `text` has another form.
std::string RowsOfRegisters(std::string_view text);

}  // namespace lyrefit
