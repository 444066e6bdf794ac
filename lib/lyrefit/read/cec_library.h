#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/read/module_sheet.h"
#include "lyrefit/read/read_pvlib.h"

namespace lyrefit {

// Whether a text begins as SAM's library of CEC modules does: with a line of column names, a_ref
// among them.
bool IsCecLibrary(const std::string& text);

// Reads one module of SAM's library of CEC modules (Dobos 2012, doi:10.1115/1.4005759), a CSV with
// the columns Name, N_s, alpha_sc (A/K), a_ref (V), I_L_ref, I_o_ref (A), R_s, R_sh_ref (ohm),
// Adjust (%) and others, a line of units and one of identifiers in brackets below them, and a row
// for each module. A row stands for De Soto's law with EgRef = 1.121 eV and dEgdT = -0.0002677 1/K.
// As in pvlib's calcparams_cec and in SAM, Adjust changes the photocurrent's coefficient alone:
// alpha_sc (1 - Adjust / 100).
//
// `row` is the Name of the module, as written or with everything but letters and digits replaced by
// "_" as in pvlib; it may be empty if there is one row only. Errors, with line and column: a
// missing column; no such module, or several; a value that no module has.
Expected<NamedParameters> ReadCecParameters(const std::string& text, const std::string& path,
                                            const std::string& row);

// Reads what the data sheet of a module prints from its row: I_sc_ref, I_mp_ref (A), V_oc_ref,
// V_mp_ref (V), alpha_sc (A/K, without Adjust), beta_oc (V/K), gamma_r (%/K), STC (W), N_s.
Expected<ModuleSheet> ReadCecSheet(const std::string& text, const std::string& path,
                                   const std::string& row);

}  // namespace lyrefit
