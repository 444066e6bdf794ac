#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"

namespace lyrefit {

// A row of a monitoring table: voltage and current at maximum power under stated conditions. NaN:
// missing.
struct OperatingReading {
  double time_s = kUnknown;  // see date_time.h
  double irradiance_W_m2 = kUnknown;
  double temperature_C = kUnknown;
  double voltage_V = kUnknown;
  double current_A = kUnknown;
};

// Reads a table with a header and one row for each time. Columns, in any order and case, with or
// without a unit: time, date, timestamp, datetime or tmst; an irradiance and a temperature as
// read/column.h knows them; vmp, v_mp, vmpp, vdc or voltage; imp, i_mp, impp, idc or current. Other
// columns are ignored. Of several inputs of an inverter (Vpv1, Ipv1, Vpv2, ...) `input` names one, as
// `--column` does. Errors, with line and column: a column that is missing; a first time that
// is no date, or one whose day and month no row tells apart; a text that is neither a number nor a word for a missing value.
Expected<std::vector<OperatingReading>> ReadOperatingTable(const std::string& path,
                                                           std::int64_t largest_file_bytes,
                                                           const std::string& input = "");

}  // namespace lyrefit
