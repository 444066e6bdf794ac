#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/family/data_sheet_family.h"
#include "lyrefit/law/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// What a data sheet prints of a module at 1000 W/m2 and 25 C. Coefficients per kelvin, not in
// percent, except that of the power.
struct DataSheetValues {
  double short_circuit_current_A = 0;  // Isc
  double open_circuit_voltage_V = 0;   // Voc
  double max_power_current_A = 0;      // Imp
  double max_power_voltage_V = 0;      // Vmp
  double alpha_sc_A_K = 0;             // of Isc
  double beta_oc_V_K = 0;              // of Voc
};

// A data sheet: its values and how exactly they are printed.
struct DataSheet {
  DataSheetValues values;
  // Half a unit of the last printed digit of each value: 0.005 for "4.70 A". 0: exact.
  DataSheetValues half_unit;
  std::optional<double> gamma_pmp_percent_K;  // of Pmp, only compared with what comes out
  int cells_in_series = 1;
};

// A value as a sheet prints it, and half a unit of its last digit.
struct PrintedValue {
  double value = 0;      // in the unit it is printed in
  double half_unit = 0;  // half of its last digit
};

// Reads "4.70"; where `whole` is given also "0.05%", which is that part of it. Error: no number.
Expected<PrintedValue> ReadPrintedValue(const std::string& text, double whole = 0);

// What was asked for and what the device found gives.
struct DataSheetCheck {
  std::string name;  // "Isc", "Voc", "Imp", "Vmp", "beta_oc", "alpha_sc", "gamma_pmp"
  std::string unit;
  double asked;  // printed
  double given;  // by the device found
};

// How far a parameter moves while the printed values move to every corner of their rounding.
struct DataSheetRange {
  std::string name;  // as in the translation
  double low;
  double high;
};

// A device that does what a data sheet prints.
struct DataSheetFit {
  Translation translation;             // De Soto, one diode
  std::vector<double> shared;          // in its order; R_sh_ref infinite where no shunt is needed
  double largest_relative_error = 0;   // of the five equations' values, the first five checks
  std::vector<DataSheetCheck> checks;  // the rest is compared, not solved for
  std::vector<DataSheetRange> ranges;  // of I_L_ref, I_o_ref, n, R_s, R_sh_ref; empty if no
                                       // rounding is stated
  DataSheetFamily family;              // all devices through the sheet's three points, of which
                                       // beta_oc picks this one
  std::vector<std::string> warnings;

  // Whether the five equations are solved, beyond the digits of any sheet.
  bool Solved() const { return largest_relative_error < 1e-6; }
};

// A member of its family as shared parameters of its translation.
std::vector<double> SharedOf(const DataSheetFit& fit, const DataSheetMember& member);

// The five parameters of the single-diode model from a data sheet alone, as pvlib's fit_desoto and
// SAM find them: the curve passes through Isc, Voc and (Vmp, Imp), its power is largest there, and
// Voc moves by beta_oc per kelvin between 25 and 27 C (De Soto, Klein and Beckman 2006,
// doi:10.1016/j.solener.2005.06.010; Dobos 2012, doi:10.1115/1.4005759), with EgRef = 1.121 eV and
// dEgdT = -0.0002677 1/K. Where no device with Rs >= 0 and Rsh > 0 does all that, the nearest one
// on that border: the curve at 25 C is kept and beta_oc given up, and a warning says so.
// Errors: values that no illuminated diode has (Imp above Isc, a fill factor of 0.95), percent
// where A/K and V/K are expected, no physical curve through the three points.
Expected<DataSheetFit> FitDataSheet(const DataSheet& sheet,
                                    ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit
