#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/model/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Shared parameters of a device from another source.
struct NamedParameters {
  std::string name;  // file name without its folder
  Translation translation;
  std::vector<double> shared;  // in the translation's order
  bool cells_stated = true;    // if false, the device counts as one cell, with equal curves
};

// Reads parameters for pvlib's calcparams_desoto or calcparams_pvsyst, the inverse of
// PvlibParameters. The file is one that PvlibJson writes, or the bare dictionary of keywords. A
// bare dictionary shows its law by its ideality (a_ref or gamma_ref). Values with a default in
// pvlib may be missing. So may De Soto's cells_in_series, which its curves do not need (pvlib's
// fit_desoto states none). R_sh_ref is infinite where it is null. Errors, with line and column if
// known: not JSON; another law; missing keys; values that are not numbers or that no device has; a
// reference other than 1000 W/m2 and 25 C.
Expected<NamedParameters> ReadPvlibParameters(const std::string& path);

}  // namespace lyrefit
