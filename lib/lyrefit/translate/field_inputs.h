#pragma once

#include <vector>

#include "lyrefit/translate/device_coefficients.h"
#include "lyrefit/translate/procedures.h"
#include "lyrefit/translate/uncertainty.h"

namespace lyrefit {

// How sure the inputs of a translation are, by the class of what they were read from. All sizes
// expanded, k = 2, normal:
//
//   irradiance    reference cell 3 %, pyranometer 5 %     as IEC 61829:2015 asks of the sensors
//                 laboratory 1.2 %                        so that Pmax comes to the 1.5 .. 1.8 %
//                                                         that laboratories state
//                 the curve itself 3 %                    usual tolerance of the rated Isc; what
//                                                         dims all cells alike is not in it
//                 unknown 5 %                             as of a pyranometer
//   temperature   1 K (IEC 61829:2015), laboratory 0.5 K, from Voc 2 K (rated Voc, 1 %)
//   cells warmer than the sensor, at 1000 W/m2 and in proportion to the irradiance
//                 corrected by 2.5 K, within 1.5 K,       2 to 3 K in an open rack, 1 K close to a
//                 for a sensor on the back                roof, 0 behind insulation: Tc = Tm +
//                                                         G / 1000 W/m2 dT (King, Boyson and
//                                                         Kratochvil 2004, SAND2004-3535,
//                                                         doi:10.2172/919131, Eq. 12);
//                                                         a known bias is corrected and its doubt
//                                                         kept (JCGM 100, 3.2.4)
//                 not corrected, within 2.5 K,            it may be one on the back
//                 for an unknown sensor
//                 else none
//   voltage, current   1 % (IEC 61829:2015), laboratory 0.2 %
//   alpha 20 %, beta 5 %   as data sheets and measurements differ, by judgement; what was assumed of
//                          a technology: twice what modules of that kind scatter by
//   epsilon 8 %            of 1.232 V, procedure 4: (Voc - T beta) / Ns of 12 measured modules of
//                          crystalline silicon is 1.19 to 1.37 V, README of the module
//   other coefficients     in parts of themselves, see UncertaintyOptions: type B, by judgement
//
// Limits that a standard asks of a sensor count as expanded uncertainties, as on the certificate of
// one that just meets them. An input of size 0 is left out: it is not used, or known exactly.
// Irradiance and temperature are taken to be unrelated; so are the gains of voltage and current.
std::vector<UncertainInput> FieldInputs(const SettledInputs& settled,
                                        const UncertaintyOptions& options);

// The quantity of each input.
using InputFields = std::vector<double TranslationInputs::*>;
InputFields FieldsOf(const std::vector<UncertainInput>& inputs);

// The values with what each input adds to its quantity: `drawn` in the order of `inputs`, whose
// quantities `fields` has; what lies behind them is left out.
TranslationInputs WithInputs(const TranslationInputs& at, const std::vector<UncertainInput>& inputs,
                             const InputFields& fields, const std::vector<double>& drawn);

// Expanded uncertainty (k = 2) of the irradiance, %, and of the temperature as read, K: of the
// options, else of their class.
double IrradianceSize_percent(const UncertaintyOptions& options);
double TemperatureSize_K(const UncertaintyOptions& options);
// How much warmer the cells are than the sensor at this irradiance, K, and the expanded uncertainty
// of that (k = 2).
double CellCorrection_K(const UncertaintyOptions& options, double irradiance_W_m2);
double CellOffsetSize_K(const UncertaintyOptions& options, double irradiance_W_m2);

}  // namespace lyrefit
