// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/data_sheet.h"
#include "lyrefit/devices/data_sheet_family.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// A value as printed on a sheet, and half a unit of its last digit.
struct PrintedValue {
  double value = 0;      // in the printed unit
  double half_unit = 0;  // half a unit of its last digit
};

// Reads "4.70". If `whole` is given, also reads "0.05%" as that percentage of `whole`. Error: not a
// number.
Expected<PrintedValue> ReadPrintedValue(const std::string& text, double whole = 0);

// A printed value beside the value of the fitted device.
struct DataSheetCheck {
  std::string name;  // "Isc", "Voc", "Imp", "Vmp", "beta_oc", "alpha_sc", "gamma_pmp"
  std::string unit;
  double asked;  // the printed value
  double given;  // the value of the fitted device
};

// Range of a parameter while the printed values take every corner of their rounding intervals.
struct DataSheetRange {
  std::string name;  // as in the translation
  double low;
  double high;
};

// A device that reproduces the printed values of a data sheet.
struct DataSheetFit {
  Translation translation;             // De Soto, one diode
  std::vector<double> shared;          // in the translation's order; no shunt: infinite R_sh_ref
  double largest_relative_error = 0;   // of the first five checks, which are solved for
  std::vector<DataSheetCheck> checks;  // further values are compared, not solved for
  std::vector<DataSheetRange> ranges;  // of I_L_ref, I_o_ref, n, R_s, R_sh_ref; empty if no
                                       // rounding is stated
  DataSheetFamily family;              // all devices through the sheet's three points; beta_oc
                                       // selects this one
  std::vector<std::string> warnings;
  bool usual = true;  // n is one of a junction

  // Whether the five equations are solved to more digits than any sheet prints.
  bool Solved() const { return largest_relative_error < 1e-6; }
};

// The shared parameters of a family member, in the order of the fit's translation.
std::vector<double> SharedOf(const DataSheetFit& fit, const DataSheetMember& member);

// Finds the five parameters of the single-diode model from a data sheet alone, as pvlib's
// fit_desoto and SAM do. The curve passes through Isc, Voc and (Vmp, Imp), its power is largest at
// (Vmp, Imp), and Voc changes by beta_oc per kelvin between 25 and 27 C (De Soto, Klein and Beckman
// 2006, doi:10.1016/j.solener.2005.06.010; Dobos 2012, doi:10.1115/1.4005759). The gap is
// the sheet's. If no device with Rs >= 0 and Rsh > 0 satisfies all equations, the
// result is the nearest device on that bound: it keeps the curve at 25 C and misses beta_oc, with a
// warning. Errors: values that no illuminated diode has (Imp above Isc, a fill factor of 0.95),
// percent where A/K and V/K are expected, a current or a voltage that
// no cell of its technology gives, no physical curve through the three points.
Expected<DataSheetFit> FitDataSheet(const DataSheet& sheet,
                                    ConstantSet constants = ConstantSet::kCodata);

}  // namespace lyrefit
