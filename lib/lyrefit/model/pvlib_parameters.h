// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Defaults of pvlib's calcparams functions. A CEC row implies both values of the band gap.
constexpr double kPvlibBandgap_eV = 1.121;
constexpr double kPvlibBandgapSlope_1_K = -0.0002677;
constexpr double kPvlibShuntExponent = 5.5;

// A parameter under pvlib's name and in pvlib's unit.
struct NamedValue {
  std::string name;  // a keyword of pvlib or a column of SAM
  double value;      // infinite for an absent shunt
};

// Shared parameters of a device from another source.
struct NamedParameters {
  std::string name;  // file name without its folder
  Translation translation;
  std::vector<double> shared;         // in the translation's order
  bool cells_stated = true;           // if false, the device counts as one cell, with equal curves
  std::vector<std::string> warnings;  // sentences on what the source states and does not agree
};

// Returns the shared parameters of a family under the names and in the units of pvlib-python. These
// are the keywords of calcparams_desoto or calcparams_cec, with cells_in_series, or of
// calcparams_pvsyst, with d2mutau and NsVbi if the translation has them. pvlib's equations then give the same curves. pvlib
// computes with CODATA constants only, so fits with other constants are converted to those. An
// infinite R_sh_ref stays infinite. Errors: two diodes; a shunt law that pvlib lacks for this
// module type; a number of values that differs from the translation's.
Expected<std::vector<NamedValue>> PvlibParameters(const Translation& translation,
                                                  const std::vector<double>& shared);

// One row of SAM's library of CEC modules (Dobos 2012, doi:10.1115/1.4005759), with the columns
// from which SAM and pvlib's calcparams_cec compute: N_s, I_sc_ref, V_oc_ref, I_mp_ref, V_mp_ref
// (A, V), alpha_sc (A/K), beta_oc (V/K), a_ref (V), I_L_ref, I_o_ref (A), R_s, R_sh_ref (ohm),
// Adjust (0 by De Soto's law), gamma_r (%/K).
struct CecModule {
  std::string name;  // of the row
  std::string technology;
  std::vector<NamedValue> values;  // in the order above
};

// Builds the CEC row of a device. Errors: those of PvlibParameters; PVsyst's law; a
// band gap other than EgRef = 1.121 eV and dEgdT = -0.0002677 1/K, which such a row cannot state; a
// device that gives no power.
Expected<CecModule> CecRow(const Translation& translation, const std::vector<double>& shared,
                           const std::string& name, const std::string& technology);

}  // namespace lyrefit
