#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/family/data_sheet.h"

namespace lyrefit {

// The values of a data sheet, those that are solved for first.
struct DataSheetRow {
  const char* name;
  const char* unit;
  double DataSheetValues::*value;
};
constexpr DataSheetRow kDataSheetRows[] = {
    {"Isc", "A", &DataSheetValues::short_circuit_current_A},
    {"Voc", "V", &DataSheetValues::open_circuit_voltage_V},
    {"Imp", "A", &DataSheetValues::max_power_current_A},
    {"Vmp", "V", &DataSheetValues::max_power_voltage_V},
    {"beta_oc", "V/K", &DataSheetValues::beta_oc_V_K},
    {"alpha_sc", "A/K", &DataSheetValues::alpha_sc_A_K},
};

// Whether some falling, concave curve may pass through the three points. Errors: one sentence that
// names the value.
Expected<void> CheckDataSheetPoints(const DataSheetValues& v);

// The same, and alpha_sc and the number of cells: what the family of a sheet takes.
Expected<void> CheckDataSheetForFamily(const DataSheet& sheet);

// The same, and beta_oc and the roundings: whether they are what they are said to be, in size and
// sign.
Expected<void> CheckDataSheet(const DataSheet& sheet);

}  // namespace lyrefit
