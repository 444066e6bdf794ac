// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// The BibTeX entry of this version of lyrefit.
std::string CiteLyrefit();

// BibTeX of lyrefit and of what nearly every fit uses: the search, the solver, the diode.
std::string CiteMethods();

// BibTeX of lyrefit and of all that a report used: searches, models, translation laws, procedures,
// effects, tests, proofs, constants, published curves. `json` is what --json writes, `source` its
// name for errors. Errors: it is not the JSON of a report.
Expected<std::string> CiteReport(const std::string& json, const std::string& source);

}  // namespace lyrefit
