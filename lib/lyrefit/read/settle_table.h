#pragma once

#include <string>
#include <string_view>

#include "lyrefit/base/error.h"
#include "lyrefit/read/table_reading.h"

namespace lyrefit {

// Settles what needs all rows of a table: the curve of a Suns-Voc trace, the unit of a current that
// names none, the sweeps of tables one below the other, columns without a sensor.
Expected<void> SettleTable(std::string_view text, const std::string& file, TableReading* reading);

}  // namespace lyrefit
