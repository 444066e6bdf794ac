#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/read/column.h"

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

}  // namespace lyrefit
