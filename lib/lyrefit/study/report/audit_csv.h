// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/study/audit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// The findings as a CSV table, one line for each row of the audit, in its order. `changes` and
// `changed_A` are those of the first explanation. Unknown values are empty.
std::string AuditCsv(const AuditReport& report);

}  // namespace lyrefit
