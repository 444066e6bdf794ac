// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/reference_comparison.h"
#include "lyrefit/diagnose/reference_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Compares a sweep with reference sweeps of its module. Compared are FF, Rs Isc / Voc, n and Gsh
// Voc / Isc of a single-diode fit, and the shape of its residuals. The values of the references are
// regressed on ln Isc and Voc, so that no curve is translated. The 40 sweeps nearest in Isc and Voc
// are used; outliers among them are left out.
//
// Fewer than four references show no scatter of their own. Under stated lights and temperatures that are
// alike, the sweep's Isc, Voc, fill factor and leak are compared with theirs, by the scatter that is usual
// of the setup; sentences name what lowers Isc and Voc together, polarisation (PID-p) among it.
//
// Errors: no usable reference sweep, or fewer than four under unknown or unlike light; other cell counts;
// a sweep more than 20 % beyond the Isc or Voc of four and more; readings that cannot be fitted; options
// outside their ranges.
Expected<ReferenceComparison> CompareWithReferences(const IvCurve& curve,
                                                    const std::vector<IvCurve>& reference,
                                                    const ReferenceOptions& options = {});

// Compares each sweep of a module with the others. Errors: fewer than five usable sweeps, other
// cell counts, options outside their ranges.
Expected<OutlierSweeps> FindOutlierSweeps(const std::vector<IvCurve>& curves,
                                          const ReferenceOptions& options = {});

}  // namespace lyrefit
