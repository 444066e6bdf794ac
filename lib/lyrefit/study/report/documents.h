// Experimental: may change in a minor version (data/stable).
#pragma once
// What a study writes: its readable report, as a document and as text for a terminal of 100 columns,
// tables, JSON and pictures. A text ends with a newline. "-" stands for unknown values. Every table of
// RMSEs names the objective.

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"
#include "lyrefit/study/audit.h"
#include "lyrefit/study/comparison.h"

namespace LYREFIT_PUBLIC lyrefit {

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

// The findings as a CSV table, one line for each row of the audit, in its order. `changes` and
// `changed_A` are those of the first explanation. Unknown values are empty.
std::string AuditCsv(const AuditReport& report);

// The audit as one JSON object. `findings` are in the order of the rows, with parameters under
// pvlib's names. `summary` holds the number of rows of every verdict. Unknown values are null.
// `constants` of a reading lists the sets under which the claim reproduces. The figures are those
// of `constants_shown`.
std::string AuditJson(const AuditReport& report);

// One header line, then one row for each run, in the order problem, algorithm, run. Studies with
// summarised problems have more columns at the end. RMSEs are in ampere, of the objective named in
// the row. Unknown values are empty fields. Fields with commas or quotation marks are quoted (RFC
// 4180). All columns except the seconds are the same on any number of threads.
std::string CompareCsv(const Comparison& comparison);

// The comparison as one JSON object, every run included. Numbers have enough digits to restore the
// same bits. The four stages have the same names as in the report of a fit. Unknown and non-finite
// values are null. Every wall-clock time is under a key named `seconds`. Apart from those the same
// seed gives the same text on any number of threads.
std::string CompareJson(const Comparison& comparison);

// Pictures of a comparison, drawn with gnuplot into a .svg, .png or .pdf file, one panel for each
// problem. A file is written completely or not at all. Errors: another extension, missing gnuplot,
// `path` not writable, nothing to draw. CheckPlot() of report/figure.h finds the first two
// beforehand.

// Box plot of the runs' distance above the reference, on a logarithmic scale. Each algorithm has a
// box for the search alone and one for the polish. Distances below 1e-10 (relative) are drawn at
// 1e-10.
Expected<void> PlotBoxes(const Comparison& comparison, const std::string& path);

// Median over the runs of the best value so far above the reference, against evaluations. Both axes
// are logarithmic.
Expected<void> PlotConvergence(const Comparison& comparison, const std::string& path);

}  // namespace lyrefit
