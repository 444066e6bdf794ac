#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "columns.h"
#include "keywords.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/read/condition_options.h"
#include "lyrefit/read/read_curve.h"

namespace lyrefit::python {

// Accepted arguments of verbs for one measured curve:
//   - voltage and current as two arguments, one-dimensional: NumPy arrays of numbers or values that
//     convert to one (lists, pandas Series),
//   - a Curve; a path or, if it has a line break, the text of a table or JSON, as for ReadCurve,
//   - a mapping or frame with the columns v or voltage, i or current (any case, with or without
//     _V and _A), and optionally sigma, time, sweep, irradiance and temperature (columns.h),
//   - a result of fit(), for its curve,
//   - an array of two rows or two columns, or a pair of arrays.
// The keywords are cells_in_series, temperature_C, irradiance_Wm2, as_is, name, and those of
// kReadOptionTable, which apply to files.
struct CurveKeywords {
  ConditionOptions told;
  ReadOptions reading;
  std::string name;
  bool area_of_device = false;  // area_cm2 is also for readings, whose device it describes
};
CurveKeywords ReadCurveKeywords(Keywords* keywords);

IvCurve CurveOf(py::handle curve, py::handle current, const CurveKeywords& said);
// A curve from the readings of a table, each with the values of its other columns.
IvCurve FromColumns(IvCurve columns, const CurveKeywords& said);
inline IvCurve TakeCurve(py::handle curve, py::handle current, Keywords* keywords) {
  return CurveOf(curve, current, ReadCurveKeywords(keywords));
}

// Whether `value` is a path or text for read_curve.
bool IsPath(py::handle value);

// Applies the given conditions to a curve; errors name the keyword.
void ApplyTold(const ConditionOptions& told, IvCurve* curve);

// Notes of the keywords of ReadCurveKeywords.
void AppendCurveNotes(std::vector<KeywordNote>* notes);

}  // namespace lyrefit::python
