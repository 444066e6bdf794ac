#pragma once

#include <string>

#include "lyrefit/study/audit_report.h"

namespace lyrefit {

// The findings as a table, one line a row of the audit, in its order. `changes` and `changed_A`
// are those of the first explanation; what is not known is empty.
std::string AuditCsv(const AuditReport& report);

}  // namespace lyrefit
