#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/audit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// The audit as one JSON object: `findings` in the order of the rows, parameters under pvlib's
// names, `bad_rows`, and in `summary` the number of rows of every verdict. What is not known is
// null. `constants` of a reading lists the sets under which the claim reproduces; the figures are
// those of `constants_shown`.
std::string AuditJson(const AuditReport& report);

}  // namespace lyrefit
