#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lyrefit {

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
