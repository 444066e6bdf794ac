#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "columns.h"
#include "keywords.h"
#include "lyrefit/curve/condition_options.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/curve/read_curve.h"

namespace lyrefit::python {

// What verbs take for one measured curve, and keywords of theirs say about it:
//   - voltage and current as two arguments, one-dimensional, of anything that is a NumPy array of
//     numbers or becomes one (lists, pandas Series),
//   - a Curve; a path or, with a line break in it, the text of a table or JSON, as ReadCurve has
//     them,
//   - a mapping or frame with the columns v or voltage, i or current (any case, with or without
//     _V and _A), and sigma, time, sweep, irradiance and temperature if it has them (columns.h),
//   - what fit() gave, whose curve it is,
//   - an array of two rows or two columns, or a pair of arrays.
// Reads the keywords cells_in_series, temperature_C, irradiance_Wm2, as_is, name, and those of
// kReadOptionTable, which are about files.
struct CurveKeywords {
  ConditionOptions told;
  ReadOptions reading;
  std::string name;
};
CurveKeywords ReadCurveKeywords(Keywords* keywords);

IvCurve CurveOf(py::handle curve, py::handle current, const CurveKeywords& said);
// A curve of readings as a table has them, each with what the columns beside it say.
IvCurve FromColumns(IvCurve columns, const CurveKeywords& said);
inline IvCurve TakeCurve(py::handle curve, py::handle current, Keywords* keywords) {
  return CurveOf(curve, current, ReadCurveKeywords(keywords));
}

// A path or text as read_curve takes it.
bool IsPath(py::handle value);

// What was told about a curve; errors name the keyword.
void ApplyTold(const ConditionOptions& told, IvCurve* curve);

// The notes of what ReadCurveKeywords reads.
void AppendCurveNotes(std::vector<KeywordNote>* notes);

}  // namespace lyrefit::python
