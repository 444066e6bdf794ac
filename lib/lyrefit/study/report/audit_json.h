// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/audit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// The audit as one JSON object. `findings` are in the order of the rows, with parameters under
// pvlib's names. `summary` holds the number of rows of every verdict. Unknown values are null.
// `constants` of a reading lists the sets under which the claim reproduces. The figures are those
// of `constants_shown`.
std::string AuditJson(const AuditReport& report);

}  // namespace lyrefit
