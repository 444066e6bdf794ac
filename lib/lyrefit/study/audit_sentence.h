#pragma once

#include <string>

#include "lyrefit/study/audit_report.h"

namespace lyrefit {

// The verdict of a finding as a sentence with numbers.
std::string AuditSentence(const AuditFinding& finding);

// The changes of a reading as text: "with Rs and Rsh per cell (x 36) and at 75 C in place of 25 C".
std::string JoinedChanges(const AuditReading& reading);

// "Rs 0.00801 below 0.2, n1 2.3 above 2"; empty if no bound is violated.
std::string LeftBoundsText(const std::vector<LeftBound>& left);

}  // namespace lyrefit
