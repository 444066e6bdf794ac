#pragma once

#include <string>

#include "lyrefit/study/audit_report.h"

namespace lyrefit {

// The audit for a terminal of 100 columns: a table for every source and curve, below it what is
// to be said about single rows, at the end a summary. '*' marks the kind of RMSE that the claims
// are of. Ends with a newline.
std::string AuditText(const AuditReport& report);

// One line a row, and the summary.
std::string BriefAudit(const AuditReport& report);

}  // namespace lyrefit
