#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/law/translation.h"

namespace LYREFIT_PUBLIC lyrefit {

// Shared parameters of a device that somebody else found.
struct NamedParameters {
  std::string name;  // of the file, without its folder
  Translation translation;
  std::vector<double> shared;  // in the translation's order
  bool cells_stated = true;    // else the device counts as one cell: its curves are the same
};

// Parameters for pvlib's calcparams_desoto or calcparams_pvsyst, the inverse of PvlibParameters:
// a file that PvlibJson writes, or the bare dictionary of keywords. Of a bare one the law shows in
// its ideality (a_ref or gamma_ref); what pvlib has a default for may be missing, as may De Soto's
// cells_in_series, which its curves do not need (pvlib's fit_desoto states none). R_sh_ref is
// infinite where it is null.
// Errors, with line and column where there are any: no JSON, another law, keys that are missing or
// no numbers, values that no device has, another reference than 1000 W/m2 and 25 C.
Expected<NamedParameters> ReadPvlibParameters(const std::string& path);

}  // namespace lyrefit
