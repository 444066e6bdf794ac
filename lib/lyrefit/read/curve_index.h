#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit {

// One row of the index of a set; unset values belong to empty fields.
struct IndexRow {
  std::optional<double> irradiance_W_m2;
  std::optional<double> temperature_C;
  std::string date;  // as written; empty: none
  Error missing;     // the error to report if the set has no such curve
};

struct CurveIndex {
  std::map<std::string, IndexRow> rows;  // by curve id
  bool states_irradiance = false;        // the index has an irradiance column
  bool states_temperature = false;
  std::vector<Assumption> assumptions;
};

enum class IndexIds {
  kNumbers,  // numbers in a table's curve column; "07" is 7
  kFiles     // names of tables, with or without extension
};

// Reads a table with one row for each curve. The column `curve`, `sweep` or `file` holds the id. Of
// several temperatures, that of the cell is preferred to that of the module. Air temperatures and
// irradiances of other planes are ignored. A column `timestamp`, `date`, `datetime` or `time` is the
// date of the measurement.
Expected<CurveIndex> ReadCurveIndex(const std::string& path, IndexIds ids,
                                    const ReadOptions& options);

}  // namespace lyrefit
