#pragma once

#include "lyrefit/base/error.h"
#include "lyrefit/curve/data_sheet.h"

namespace lyrefit {

// Names, units and fields of the values of a data sheet. The first five are solved for.
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

// Checks that some falling, concave curve can pass through the three points. Errors: one sentence
// that names the value.
Expected<void> CheckDataSheetPoints(const DataSheetValues& v);

// Checks the values that FindDataSheetFamily needs: CheckDataSheetPoints, alpha_sc and the number
// of cells.
Expected<void> CheckDataSheetForFamily(const DataSheet& sheet);

// Junctions in each of the cells that a sheet counts: 1 where those of a stack are counted as cells.
int JunctionsOfSheet(const DataSheet& sheet);

// Checks current and voltage against what a cell of the sheet's technology gives under one sun.
// Errors: a current in milliampere; a voltage a cell above that of the technology, of silicon where
// none is stated. A stated band gap stands for any voltage below it.
Expected<void> CheckSheetOfMaterial(const DataSheet& sheet);

// Checks all values: CheckDataSheetForFamily, and the size and sign of beta_oc and the roundings.
Expected<void> CheckDataSheet(const DataSheet& sheet);

}  // namespace lyrefit
