// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>

#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Values that a data sheet prints for a module at 1000 W/m2 and 25 C. Both coefficients are
// absolute, per kelvin, not in percent.
struct DataSheetValues {
  double short_circuit_current_A = 0;  // Isc
  double open_circuit_voltage_V = 0;   // Voc
  double max_power_current_A = 0;      // Imp
  double max_power_voltage_V = 0;      // Vmp
  double alpha_sc_A_K = 0;             // temperature coefficient of Isc
  double beta_oc_V_K = 0;              // temperature coefficient of Voc
};

// A data sheet: its values and the precision they are printed with.
struct DataSheet {
  DataSheetValues values;
  // Half a unit of the last printed digit of each value: 0.005 for "4.70 A". 0: the value is exact.
  DataSheetValues half_unit;
  std::optional<double> gamma_pmp_percent_K;  // of Pmp; only compared with the result
  int cells_in_series = 1;
  std::string technology;  // "Mono-c-Si", "mtCdTe", "CIGS"; empty: not stated
  // Of De Soto's law: the band gap at 25 C and its relative slope; unset: those of the technology,
  // and silicon's where that is not known.
  std::optional<double> EgRef_eV;
  std::optional<double> dEgdT_1_K;
};

}  // namespace lyrefit
