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

// Finds systematic deviations of the data from the base model, their causes, and the gain of
// modelling them. The set holds one curve (one sweep, or up and down), a lit and a dark curve
// (irradiance 0), or a family over irradiance and temperature. The points of each curve are in the
// order of measurement.
//
// Errors: an unusable curve, options outside their ranges, unknown effect ids, own effects that
// cannot be fitted, fewer than 7 readings, readings that no diode model fits.
Expected<Diagnosis> Diagnose(const CurveSet& taken, const DiagnoseOptions& options = {},
                             const Observer& observer = {});
Expected<Diagnosis> Diagnose(const IvCurve& curve, const DiagnoseOptions& options = {},
                             const Observer& observer = {});

// Reads every format of ReadCurve and ReadCurveSet, as one measurement. Up and down sweeps stay
// together; sweeps under other conditions, also a dark one, become curves of the set. Errors: those
// of the two readers. Curves of a set that cannot be read are listed in `rejected`.
Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options = {});

// Reads several files as one measurement: a lit and a dark curve, or a family. Sweeps up and down
// under one condition are joined to one curve in the order given, without the times, irradiances
// and temperatures of their readings. Errors: those of the first file that cannot be read.
Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options = {});

}  // namespace lyrefit
