#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/read/key_point_table.h"

namespace lyrefit {

// One condition of a table of key points, in W/m2, C, A, V and W.
struct KeyPointCondition {
  double irradiance_W_m2 = 0;
  double temperature_C = 0;
  int line = 0;
  std::array<std::optional<double>, kKeyPoints> points;
};

// Error: columns whose values are those of each other. A current follows the light and a voltage
// hardly; Imp is below Isc and Vmp below Voc. `line`: of the names of the columns.
Expected<void> CheckKeyPointColumns(const std::vector<KeyPointCondition>& conditions,
                                    const std::string& path, int line);

// "line 12: Imp 7.578 A is above Isc 7.359 A, ..." for each condition that no device has.
std::vector<std::string> ImpossibleConditions(const std::vector<KeyPointCondition>& conditions);

// "-", as tables write what was not measured.
bool IsDash(std::string_view text);

}  // namespace lyrefit
