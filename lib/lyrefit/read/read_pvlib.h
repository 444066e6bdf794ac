// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/pvlib_parameters.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads parameters for pvlib's calcparams_desoto, calcparams_cec or calcparams_pvsyst, the inverse
// of PvlibParameters and CecRow. Adjust, in percent, of calcparams_cec and of a CEC row changes
// alpha_sc to alpha_sc (1 - Adjust / 100), as there; its cells may be called N_s. The file is one
// that PvlibJson writes, or the bare dictionary of keywords. A bare dictionary shows its law by its
// ideality (a_ref or gamma_ref). Values with a default in pvlib may be missing. So may De Soto's cells_in_series, which its curves do not need (pvlib's
// fit_desoto states none). R_sh_ref is infinite where it is null. Errors, with line and column if
// known: not JSON; another law; missing keys; values that are not numbers or that no device has; a
// reference other than 1000 W/m2 and 25 C.
Expected<NamedParameters> ReadPvlibParameters(const std::string& path);

}  // namespace lyrefit
