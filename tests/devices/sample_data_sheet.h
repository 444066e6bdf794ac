#pragma once

#include <limits>

#include "lyrefit/devices/data_sheet.h"

namespace lyrefit {

// A data sheet result written by hand, with every section filled.
inline DataSheetFit SampleDataSheetFit() {
  DataSheetFit fit;
  TranslationSpec spec;
  spec.cells_in_series = 36;
  fit.translation = *MakeTranslation(spec);
  // Iph, Is1, n1, Rs, Rsh, alpha, Eg, dEg
  fit.shared = {4.7,   5.3e-10, 1.02,      0.39, std::numeric_limits<double>::infinity(),
                0.002, 1.121,   -0.0002677};
  fit.largest_relative_error = 1.2e-13;
  fit.checks = {{"Isc", "A", 4.7, 4.7}, {"beta_oc", "V/K", -0.076, -0.0761}};
  fit.ranges = {{"n", 1.0, 1.04}, {"R_s", 0.37, 0.41}};
  fit.warnings = {"no shunt is needed"};
  return fit;
}

// Printed values of a data sheet. The family of devices with these values ends at infinite shunt
// resistance.
inline DataSheet SampleSheet() {
  DataSheet sheet;
  sheet.values = {8.21, 32.9, 7.61, 26.3, 0.00318, -0.123};
  sheet.half_unit = {0.005, 0.05, 0.005, 0.05, 0.000005, 0.0005};
  sheet.cells_in_series = 54;
  return sheet;
}

}  // namespace lyrefit
