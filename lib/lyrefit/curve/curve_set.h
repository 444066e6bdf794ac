#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace LYREFIT_PUBLIC lyrefit {

// A curve of a set that could not be read, and why.
struct RejectedCurve {
  std::string id;
  Error error;
};

// Curves of one device under different irradiance and temperature. IvCurve::name is the curve's id,
// unique within the set.
struct CurveSet {
  std::string name;    // "sandia_pvue125"
  std::string source;  // file or folder
  std::vector<IvCurve> curves;
  std::vector<RejectedCurve> rejected;  // the others are there nevertheless
  std::vector<Assumption> assumptions;  // what holds for every curve
};

// Reads a set from
//   - a folder that holds curves.csv (columns curve, voltage, current) and, beside it, index.csv
//     with one row a curve (curve, irradiance, temperature, other columns are left alone) and
//     dataset.json (a sidecar with what holds for all curves),
//   - one table with a `curve` or `sweep` column, conditions per row, in a sidecar NAME.json or in
//     an index file NAME-index.csv beside it,
//   - a folder of tables, one curve each, each with its own sidecar or with a row of index.csv
//     (column `curve` or `file`),
//   - one table with several currents over one voltage, or several pairs, side by side,
//   - a JSON file with many curves, as ReadCurve knows them.
// A condition that nobody states is left at its default with irradiance_known or temperature_known
// false. Ids that occur twice, rows of the index without a curve and the like are errors; a file of
// a folder or a curve of a table that is broken goes to `rejected`, unless nothing is left.
Expected<CurveSet> ReadCurveSet(const std::string& path, const ReadOptions& options = {});

// Whether `path` holds several curves, as ReadCurveSet understands it. A pipe is not looked into:
// false.
bool HoldsCurveSet(const std::string& path, const ReadOptions& options = {});

// A curve as a set of its own.
CurveSet SetOfOne(IvCurve curve);

}  // namespace lyrefit
