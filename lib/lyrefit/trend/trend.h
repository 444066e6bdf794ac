// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"
#include "lyrefit/trend/trend_series.h"

namespace LYREFIT_PUBLIC lyrefit {

// What changed in a device over time.
//
// 1. Every measurement is reduced to standard conditions (trend_series.h).
// 2. What the law leaves of light and temperature is found within days, where no trend is.
// 3. The robust means of the days are a regression on time with steps and onsets, and errors that
//    neighbouring days share. A step or an onset is claimed where series without one show as much
//    at the stated rate.
// 4. The power that the device of the reference days would have given is split into what light,
//    series resistance, recombination, shunt and mismatch take: shares by Shapley, which add up.
//
// Errors: fewer than five days (or blocks of a shorter series) with usable measurements; options
// outside their ranges; the observer stops it (a series whose reading was stopped is judged without
// the observer, as far as it goes).
Expected<TrendReport> FindTrend(const TrendSeries& series, const TrendOptions& options = {},
                                const Observer& observer = {});

}  // namespace lyrefit
