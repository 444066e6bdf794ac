#pragma once

#include <vector>

#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// Uncertainties of the inputs of a translation, by the class of their sensor. All sizes are
// expanded, k = 2, and normal:
//
//   irradiance    reference cell 3 %, pyranometer 5 %     required of the sensors by IEC 61829:2015
//                 laboratory 1.2 %                        so that Pmax has the 1.5 .. 1.8 % that
//                                                         laboratories state
//                 the curve itself 3 %                    usual tolerance of the rated Isc, without
//                                                         losses common to all cells
//                 unknown 5 %                             as for a pyranometer
//   temperature   1 K (IEC 61829:2015), laboratory 0.5 K, from Voc 2 K (rated Voc, 1 %)
//   cells warmer than the sensor, at 1000 W/m2 and in proportion to the irradiance
//                 corrected by 2.5 K, within 1.5 K,       2 to 3 K in an open rack, 1 K close to a
//                 for a sensor on the back                roof, 0 behind insulation: Tc = Tm +
//                                                         G / 1000 W/m2 dT (King, Boyson and
//                                                         Kratochvil 2004, SAND2004-3535,
//                                                         doi:10.2172/919131, Eq. 12);
//                                                         a known bias is corrected and its
//                                                         uncertainty kept (JCGM 100, 3.2.4)
//                 not corrected, within 2.5 K,            the sensor may be on the back
//                 for an unknown sensor
//                 else none
//   voltage, current   1 % (IEC 61829:2015), laboratory 0.2 %
//   alpha 20 %, beta 5 %   difference of data sheets and measurements, by judgement; where assumed
//                          by technology: twice the standard deviation among its modules
//   epsilon 8 %            of 1.232 V, procedure 4: (Voc - T beta) / Ns of 12 measured modules of
//                          crystalline silicon is 1.19 to 1.37 V, README of the module
//   other coefficients     relative, see UncertaintyOptions: type B, by judgement
//
// Limits that a standard sets for a sensor count as expanded uncertainties, as on the certificate
// of a sensor that just meets them. An input of size 0 is left out: it is not used, or known
// exactly. Irradiance and temperature are treated as independent, as are the gains of voltage and
// current.
std::vector<UncertainInput> FieldInputs(const SettledInputs& settled,
                                        const UncertaintyOptions& options);

// The quantity of each input.
using InputFields = std::vector<double TranslationInputs::*>;
InputFields FieldsOf(const std::vector<UncertainInput>& inputs);

// Adds to each quantity of `at` the deviations of its inputs from their values. `drawn` is in the
// order of `inputs`; `fields` are their quantities. Inputs beyond the end of `fields` are ignored.
TranslationInputs WithInputs(const TranslationInputs& at, const std::vector<UncertainInput>& inputs,
                             const InputFields& fields, const std::vector<double>& drawn);

// A source of the irradiance.
struct LightClass {
  LightSource source;
  const char* sensor;  // what it is
  const char* by;      // the same, after a value
  const char* title;   // of its line in a budget
  double percent;      // expanded uncertainty (k = 2)
  const char* why;     // reason for this size
};
const LightClass& LightClassOf(LightSource source);

// Expanded uncertainty (k = 2) of the irradiance in percent and of the measured temperature in K,
// from the options or by class.
double IrradianceSize_percent(const UncertaintyOptions& options);
double TemperatureSize_K(const UncertaintyOptions& options);
// Cell minus sensor temperature at this irradiance, K, and its expanded uncertainty (k = 2).
double CellCorrection_K(const UncertaintyOptions& options, double irradiance_W_m2);
double CellOffsetSize_K(const UncertaintyOptions& options, double irradiance_W_m2);

}  // namespace lyrefit
