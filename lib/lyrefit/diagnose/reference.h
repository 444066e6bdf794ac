#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/reference_comparison.h"
#include "lyrefit/diagnose/reference_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Compares by a single diode's FF, Rs Isc / Voc, n and Gsh Voc / Isc and by the shape of what it
// misses, each reference sweep's regressed on ln Isc and Voc, so that no curve is translated; the
// 40 sweeps nearest in Isc and Voc count. Reference sweeps that are outliers among the others are left
// out.
//
// Errors: fewer than four reference sweeps that can be used, other cell counts, a sweep more than 20
// % beyond the reference sweeps' Isc or Voc, readings that cannot be fitted, options outside their
// ranges.
Expected<ReferenceComparison> CompareWithReferences(const IvCurve& curve,
                                               const std::vector<IvCurve>& reference,
                                               const ReferenceOptions& options = {});

// Errors: fewer than five sweeps that can be compared, options outside their ranges.
Expected<OutlierSweeps> FindOutlierSweeps(const std::vector<IvCurve>& curves,
                                  const ReferenceOptions& options = {});

}  // namespace lyrefit
