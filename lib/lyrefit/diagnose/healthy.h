#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/diagnose/healthy_comparison.h"
#include "lyrefit/diagnose/healthy_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Compares by a single diode's FF, Rs Isc / Voc, n and Gsh Voc / Isc and by the shape of what it
// misses, each healthy sweep's regressed on ln Isc and Voc, so that no curve is translated; the
// 40 sweeps nearest in Isc and Voc count. Healthy sweeps that are odd among the others are left
// out.
//
// Errors: fewer than four healthy sweeps that can be used, other cell counts, a sweep more than 20
// % beyond the healthy sweeps' Isc or Voc, readings that cannot be fitted, options outside their
// ranges.
Expected<HealthyComparison> CompareWithHealthy(const IvCurve& curve,
                                               const std::vector<IvCurve>& healthy,
                                               const HealthyOptions& options = {});

// Errors: fewer than five sweeps that can be compared, options outside their ranges.
Expected<OddSweeps> FindOddSweeps(const std::vector<IvCurve>& curves,
                                  const HealthyOptions& options = {});

}  // namespace lyrefit
