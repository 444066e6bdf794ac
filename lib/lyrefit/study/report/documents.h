// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// The readable report of each study, as a document and as text for a terminal of 100 columns. The
// text ends with a newline. "-" stands for unknown values. Every table of RMSEs names the
// objective.
namespace LYREFIT_PUBLIC lyrefit {

struct AuditReport;
struct Comparison;

// An audit: a table for every source and curve, remarks on single rows below it, and a summary at
// the end. '*' marks the type of RMSE that the claims are of.
Document AuditDocument(const AuditReport& report);
std::string AuditText(const AuditReport& report);
// One line for each row, and the summary.
std::string BriefAudit(const AuditReport& report);

// A comparison: for each problem the RMSE of the search alone and after the polish, their cost,
// their hits, and the results of the rank tests.
Document CompareDocument(const Comparison& comparison);
std::string CompareText(const Comparison& comparison);

}  // namespace lyrefit
