#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/column.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/text_encoding.h"

// Key points of one device over irradiance and temperature, as test laboratories report them (the
// matrix of IEC 61853-1). Two layouts are read:
//   - long: one row a condition, with columns of irradiance, cell temperature, Isc, Voc, Imp and Vmp
//     under pvlib's names (effective_irradiance, temp_cell, i_sc, ...), those of mPERT or of data
//     sheets; other columns are not used,
//   - wide: for each key point a line with its name and unit, then a row of temperatures and below
//     it a row for each irradiance.
// Lines above may state cells in series.

namespace lyrefit {

enum KeyPoint { kIsc, kVoc, kImp, kVmp, kPmp, kKeyPoints };

// A column of key points and the factor to A, V or W.
struct KeyPointColumn {
  KeyPoint point;
  double factor = 1;
};

// Interprets a label such as "i_sc_A", "Vpm (V)", "Leerlaufspannung [V]" or "current at maximum power".
std::optional<KeyPointColumn> AsKeyPoint(std::string_view label);

// The columns of a matrix: key points of one device over light and temperature, a row a condition.
struct MatrixColumns {
  std::vector<std::optional<KeyPointColumn>> points;  // one for each name
  Column irradiance, temperature;
  int irradiance_place = -1;
  int temperature_place = -1;
};

// Interprets the names of a table's columns: light, temperature and three key points or more, of
// them Isc or Voc, and no other voltage or current.
std::optional<MatrixColumns> AsMatrix(const std::vector<std::string>& names);

// Whether a text is such a table with two conditions or more.
bool HoldsKeyPoints(const std::string& text, const std::string& path);

// Reads the table as a set of one curve a condition, whose readings are (0, Isc), (Vmp, Imp) and
// (Voc, 0). The sidecar and an empty field count as for other tables; a condition without two
// readings is rejected. `common` is the path of the sidecar. Errors: no such table.
Expected<CurveSet> ReadKeyPoints(const DecodedText& text, const std::string& path,
                                 const std::string& common, const ReadOptions& options);

}  // namespace lyrefit
