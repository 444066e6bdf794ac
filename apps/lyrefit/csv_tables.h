#pragma once

#include <string>
#include <vector>

#include "lyrefit/certify/certify.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/healthy.h"
#include "lyrefit/family/data_sheet.h"
#include "lyrefit/study/coverage.h"

namespace lyrefit {

// What --csv of these verbs writes: a row for each thing found, its numbers as they read back to
// the same bits, what is not known empty. Powers and currents are in parts as in the library, not
// in percent.

// A row a cause, those below the floor after those that are named; of a measurement without any one
// row with nothing but its name and the verdict.
std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses);

// A row a sweep, the oddest first.
std::string OddSweepsCsv(const OddSweeps& odd);

// The floor and each model.
std::string CertificateCsv(const Certificate& certificate);

// A row a parameter.
std::string CoverageCsv(const CoverageReport& report);
std::string DataSheetCsv(const DataSheetFit& fit);

}  // namespace lyrefit
