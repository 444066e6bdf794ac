#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "curves.h"
#include "lyrefit/curve/curve_set.h"

namespace lyrefit::python {

// Accepted arguments of verbs for a measurement of one or several curves:
//   - a path, as for read_curve and the command: a table with several curves, a folder, JSON; or a
//     list of paths, read as one measurement,
//   - a long frame or mapping with a column curve (curve_id, id) as curve id, besides voltage and
//     current, and irradiance and temperature if they are known,
//   - a list of single curves, each as for CurveOf, or a mapping from their ids,
//   - a single curve, with `current` or without.
// The keywords apply to every curve.
CurveSet SetOf(py::handle curves, py::handle current, const CurveKeywords& said);

// Whether `value` is a list, tuple or mapping of curves, not one curve.
bool IsSeveral(py::handle value);

// The curves of several measurements, each as for SetOf.
std::vector<IvCurve> SweepsOf(py::handle value, const CurveKeywords& said);

}  // namespace lyrefit::python
