// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// Each record as a document, as text for a terminal of 100 columns, and as one line that ends with
// a newline. "-" marks an unknown value. Every RMSE has its label, measured-current or
// solved-current.
namespace LYREFIT_PUBLIC lyrefit {

struct FitReport;
struct FittedFile;

// A fit: the verdict, the results and, left out of the short report, their reliability. '*' marks the fitted objective.
Document FitDocument(const FitReport& report);
std::string ShortReport(const FitReport& report);
std::string FullReport(const FitReport& report);
std::string BriefReport(const FitReport& report);

// The fits of several files, one row for each, and the reasons of those that failed.
Document FitsDocument(const std::vector<FittedFile>& fits);

}  // namespace lyrefit
