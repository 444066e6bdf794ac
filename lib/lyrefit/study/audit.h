// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/audit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Checks published parameter rows against the curves they are said to fit. It computes whether the
// claimed RMSE follows from the printed digits, and otherwise which simple mistake explains it.

// Audits every row of the table at `path`; ReadAuditRows describes its format. A row names its
// device as ReadCurve names a curve. The curve is looked up beside the table, in the parent of the
// table's folder, and in `options.curve_folders`. Every folder there with a curve.csv is also a
// candidate for the device a row really describes. Errors: an unreadable table, a missing folder.
Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options = {});

}  // namespace lyrefit
