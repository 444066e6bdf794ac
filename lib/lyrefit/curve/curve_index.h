#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit {

// What the index of a set says about one curve; empty where its field is.
struct IndexRow {
  std::optional<double> irradiance_W_m2;
  std::optional<double> temperature_C;
  Error missing;  // what to answer if the set has no such curve
};

struct CurveIndex {
  std::map<std::string, IndexRow> rows;  // by the id of the curve
  bool states_irradiance = false;        // there is such a column
  bool states_temperature = false;
  std::vector<Assumption> assumptions;
};

enum class IndexIds {
  kNumbers,  // of a table's curve column; "07" is 7
  kFiles     // names of tables, with or without their ending
};

// Reads a table of one row a curve: a column `curve`, `sweep` or `file` says which. Of several
// temperatures the cell's goes before the module's; those of the air and irradiances of other
// planes are left alone.
Expected<CurveIndex> ReadCurveIndex(const std::string& path, IndexIds ids,
                                    const ReadOptions& options);

}  // namespace lyrefit
