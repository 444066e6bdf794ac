// Experimental: may change in a minor version (data/stable).
#pragma once

#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/two_junction_options.h"
#include "lyrefit/devices/two_junction_report.h"
#include "lyrefit/estimate/fit/fit_options.h"

namespace LYREFIT_PUBLIC lyrefit {

// Fits a device of two junctions in series (model/two_junctions.h) to one curve or to several under
// different lights of its junctions: Is, n and Rsh of each junction, one Rs, and the photocurrents.
// A curve whose light of a junction is stated (TwoJunctionOptions::lights, DeviceNotes::light_top
// and light_bottom) has that share of the common photocurrent; otherwise its photocurrent is an
// unknown of this curve. If no curve states a light, the first is the reference.
//
// MLO searches the bounds; its elites and starts from the shape of the curves are refined by
// bounded least squares of the solved currents with exact derivatives. Intervals are profiles where
// the problem is not linear enough. A parameter that the data do not limit on both sides is not
// identifiable, and the report names the measurement that would decide.
//
// Errors: no curve, a dark or invalid curve, temperatures that differ by more than 1 K, unknown
// names, a light that is not positive, ranges out of order, too few readings.
Expected<TwoJunctionReport> FitTwoJunctions(const CurveSet& set,
                                            const TwoJunctionOptions& options = {},
                                            const Observer& observer = {});

// The curves of several measurements as one set for FitTwoJunctions(). Error: two curves of one
// name.
Expected<CurveSet> GatherCurves(std::vector<CurveSet> sets);

// `options` with bounds, fixed values, constants, search, intervals and threads of a fit.
TwoJunctionOptions WithOptionsOf(const FitOptions& fit, TwoJunctionOptions options);

}  // namespace lyrefit
