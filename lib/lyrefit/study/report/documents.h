#pragma once

#include <string>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// What there is to read of each study: as a document, and drawn for a terminal of 100 columns, which
// ends with a newline. "-" stands for what is not known; every table of RMSEs names the objective.
namespace LYREFIT_PUBLIC lyrefit {

struct AuditReport;
struct Comparison;
struct CoverageReport;
struct TruthComparison;

// An audit: a table for every source and curve, below it what is to be said about single rows, at
// the end a summary. '*' marks the kind of RMSE that the claims are of.
Document AuditDocument(const AuditReport& report);
std::string AuditText(const AuditReport& report);
// One line a row, and the summary.
std::string BriefAudit(const AuditReport& report);

// A comparison: for each problem the RMSE of the search alone and after the polish, what they cost,
// how often they hit, and what the rank tests make of it.
Document CompareDocument(const Comparison& comparison);
std::string CompareText(const Comparison& comparison);

// Algorithms of BudgetAlgorithms(): hits by algorithm and budget, one table a polish level; then
// problems of many local optima, summed up over their devices.
Document BudgetDocument(const Comparison& comparison);
std::string BudgetText(const Comparison& comparison);

// Algorithms of SensitivityAlgorithms(): grids of Pm and gamma.
Document SensitivityDocument(const Comparison& comparison);
std::string SensitivityText(const Comparison& comparison);

// How often the 95 % intervals of joint fits hold the truth.
Document CoverageDocument(const CoverageReport& report);
std::string CoverageText(const CoverageReport& report);

// Fits held against known parameters.
Document TruthDocument(const TruthComparison& comparison);
std::string TruthText(const TruthComparison& comparison);

}  // namespace lyrefit
