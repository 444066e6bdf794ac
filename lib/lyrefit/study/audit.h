#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/study/audit_options.h"
#include "lyrefit/study/audit_report.h"

namespace LYREFIT_PUBLIC lyrefit {

// Checks published parameter rows against the curves they are said to fit: does the claimed RMSE
// come out of the printed digits, and if not, which plain mistake brings it back?

// Audits every row of the table at `path`, see ReadAuditRows. A row's device is a curve as
// ReadCurve takes it, looked up beside the table, in the parent of its folder, and in
// `options.curve_folders`; every folder there that holds a curve.csv may turn out to be the device
// a row really belongs to. Errors: the table as a whole, a folder that is not there.
Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options = {});

}  // namespace lyrefit
