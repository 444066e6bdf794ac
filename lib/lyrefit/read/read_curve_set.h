// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/read/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// Reads a set from one of these sources:
//   - a folder with curves.csv (columns curve, voltage, current) and, beside it, index.csv with one
//     row for each curve (curve, irradiance, temperature; other columns are ignored) and
//     dataset.json (a sidecar for all curves),
//   - one table with a `curve` or `sweep` column and conditions in its rows, in a sidecar NAME.json
//     or in an index file NAME-index.csv beside it,
//   - a folder of tables of one curve each, with separate sidecars or with rows of index.csv
//     (column `curve` or `file`),
//   - one table with several measurements side by side, or with key points (key_point_table.h),
//   - a JSON file with many curves, in the formats that ReadCurve reads.
// A condition that is not stated has its default, with irradiance_known or temperature_known false.
// Errors include ids that occur twice and rows of the index without a curve. An invalid file of a
// folder or curve of a table is added to `rejected`; it is an error if no valid curve remains.
// Experimental, as the readers' options are.
Expected<CurveSet> ReadCurveSet(const std::string& path, const ReadOptions& options = {});

// Reads every format of ReadCurve and ReadCurveSet, as one measurement. Up and down sweeps stay
// together; sweeps under other conditions, also a dark one, become curves of the set. Errors: those
// of the two readers. Curves of a set that cannot be read are listed in `rejected`. Experimental.
Expected<CurveSet> ReadMeasurement(const std::string& path, const ReadOptions& options = {});

// Reads several files as one measurement: a lit and a dark curve, or a family. Sweeps up and down
// under one condition are joined to one curve in the order given, without the times, irradiances
// and temperatures of their readings. Errors: those of the first file that cannot be read.
// Experimental.
Expected<CurveSet> ReadMeasurement(const std::vector<std::string>& paths,
                                   const ReadOptions& options = {});

// Whether ReadCurveSet would find several curves in `path`. False for a pipe, which is not read.
// Experimental.
bool HoldsCurveSet(const std::string& path, const ReadOptions& options = {});

}  // namespace lyrefit
