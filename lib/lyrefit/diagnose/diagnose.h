#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"
#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace LYREFIT_PUBLIC lyrefit {

// What the base model gets wrong in these data, why, and what allowing for it gains. The set holds
// one curve (one sweep, or up and down), a lit and a dark curve (irradiance 0), or a family over
// irradiance and temperature; the points of each curve are in the order taken.
//
// Errors: an unusable curve, options outside their ranges, unknown effect ids, own effects that
// cannot be fitted, fewer points than parameters.
Expected<Diagnosis> Diagnose(const CurveSet& taken, const DiagnoseOptions& options = {},
                             const Observer& observer = {});
Expected<Diagnosis> Diagnose(const IvCurve& curve, const DiagnoseOptions& options = {},
                             const Observer& observer = {});

// Reads what ReadCurve or ReadCurveSet understand, as one measurement: up and down sweeps stay
// together, sweeps under other conditions (a dark one among them) become curves of the set. Errors:
// those of the two; of a set a curve that cannot be read is in `rejected`.
Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options = {});

// Several files as one measurement: a lit and a dark curve, a family; sweeps up and down under one
// condition become one curve in the order given, without the times, light and temperature of its
// readings. Errors: the first file that cannot be read.
Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options = {});

}  // namespace lyrefit
