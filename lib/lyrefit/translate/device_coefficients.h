// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/translate/procedures.h"

namespace LYREFIT_PUBLIC lyrefit {

// Coefficients of a device from a data sheet or a laboratory. Alpha and beta are absolute or
// relative; relative values refer to Isc and Voc at standard conditions.
struct StatedCoefficients {
  std::optional<double> alpha_A_K;
  std::optional<double> alpha_percent_K;
  std::optional<double> beta_V_K;
  std::optional<double> beta_percent_K;
  std::optional<double> kappa_ohm_K;
  std::optional<double> resistance_series_ohm;
  std::optional<double> b1;
  std::optional<double> b2;
  std::optional<double> epsilon_V;
  std::optional<double> EgRef_eV;
  std::optional<double> dEgdT_1_K;
  std::optional<double> mu_gamma_1_K;
};

// Read one coefficient: "-0.3%" is in percent per kelvin, "-0.12" in A/K or V/K.
Expected<void> ReadAlpha(const std::string& text, StatedCoefficients* coefficients,
                         const TextReaders&);
Expected<void> ReadBeta(const std::string& text, StatedCoefficients* coefficients,
                        const TextReaders&);
std::vector<std::string> AlphaTexts(const StatedCoefficients& coefficients);
std::vector<std::string> BetaTexts(const StatedCoefficients& coefficients);

inline constexpr OptionRow<StatedCoefficients> kCoefficientTable[] = {
    OptionRow<StatedCoefficients>("Coefficients"),
    {"alpha", "A/K|%", "temperature coefficient of Isc in A/K, or in percent: 0.05%",
     OptionText<StatedCoefficients>{ReadAlpha, AlphaTexts}, OptionTrait::kNoDefault},
    {"beta", "V/K|%", "temperature coefficient of Voc in V/K, or in percent: -0.3%",
     OptionText<StatedCoefficients>{ReadBeta, BetaTexts}, OptionTrait::kNoDefault},
    {"kappa", "ohm/K", "curve correction factor of procedures 1 and 2",
     &StatedCoefficients::kappa_ohm_K, -100, 100},
    {"rs", "OHM", "internal series resistance of procedures 1, 2 and 4",
     &StatedCoefficients::resistance_series_ohm, 0, 1e6},
    {"b1", "", "procedure 2: Voc(STC) / Voc(G) = 1 + B1 ln(1000 / G) + B2 ln(1000 / G)^2",
     &StatedCoefficients::b1, -10, 10},
    {"b2", "", "see --b1", &StatedCoefficients::b2, -10, 10},
    {"epsilon", "V", "procedure 4: n Eg / q of one cell, 1.232 for crystalline silicon",
     &StatedCoefficients::epsilon_V, 1e-3, 20},
    {"bandgap", "eV", "band gap at 25 C; without it De Soto's has Voc move by beta",
     &StatedCoefficients::EgRef_eV, 1e-3, 20},
    {"bandgap-slope", "1/K", "its relative slope with temperature", &StatedCoefficients::dEgdT_1_K,
     -0.1, 0.1},
    {"mu-gamma", "1/K", "PVsyst's slope of the ideality; without it Voc moves by beta",
     &StatedCoefficients::mu_gamma_1_K, -1, 1},
};

// Reads coefficients from a JSON file, at the top or under "coefficients": alpha_sc_A_K or
// alpha_sc_percent_K, beta_oc_V_K or beta_oc_percent_K, kappa_ohm_K, resistance_series_ohm, B1, B2,
// epsilon_V, EgRef_eV, dEgdT_1_K and mu_gamma_1_K. The sidecar names alpha_Isc_A_per_K and
// beta_Voc_V_per_K are accepted too. Values that are set in `coefficients` already are kept.
// Errors: no JSON object, a value that is no number, no coefficient at all.
Expected<void> ReadCoefficients(const std::string& path, StatedCoefficients* coefficients);

// Values of all inputs of a translation, and their origin.
struct SettledInputs {
  TranslationInputs values;
  std::vector<std::string> assumptions;  // sentences on values that nobody stated
  // Relative standard deviations of assumed values; none: the value is stated or not used.
  std::optional<double> alpha_scatter;
  std::optional<double> beta_scatter;
  std::string usual_of;              // technology of the assumed values
  double usual_gamma_percent_K = 0;  // its temperature coefficient of Pmax, where none is stated
  double cell_correction_K = 0;      // included in `values`: cell minus sensor temperature
  bool bandgap_stated = false;       // else De Soto's band gap is fitted so that Voc follows beta
  bool mu_gamma_stated = false;      // else PVsyst's mu_gamma is fitted so that Voc follows beta
  bool crystalline_silicon = true;   // procedure 4 applies to no other technology
};

// Completes the stated coefficients: alpha, beta and the band gap by technology, kappa, Rs, B1 and
// B2 by the fit and the shape of the curve:
//   kappa = (Voc - Vmp - Rs Imp) / (T1 Imp)   so that the voltage at maximum power moves like that
//                                             of a junction, in proportion to its distance from the
//                                             barrier
//   B1 = Ns n k 298 K / (q Voc_stc), B2 = B1^2   of an illuminated diode
// `values` holds the measured inputs: irradiance, temperature, gains, leads.
SettledInputs SettleInputs(const StatedCoefficients& stated, const std::string& technology,
                           const PreparedCurve& curve, TranslationInputs values);

}  // namespace lyrefit
