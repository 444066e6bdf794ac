#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "keywords.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit::python {

// One of many curves, perhaps not read yet. Reading needs nothing of Python's.
struct CurveToFit {
  std::string id;
  std::string file;  // beside which published bounds lie; empty: none
  std::function<Expected<IvCurve>()> read;
};

// What verbs on many curves take:
//   - voltage and current as two arrays of shape (m, n), a curve a row, whose NaNs pad; voltage may
//     have the shape (n,) for all of them,
//   - a list, or a mapping by id, of what one curve may be,
//   - a long DataFrame, a row a reading, with the columns that name a curve in `group`; the columns
//     cells_in_series, temperature_C and irradiance_Wm2 say what they say,
//   - the path of a folder or file with many, as the command's batch reads them.
// Reads the keywords group, ids, and those of one curve, of which the conditions may be arrays of
// shape (m,).
std::vector<CurveToFit> TakeManyCurves(py::handle curves, py::handle current, Keywords* keywords);

void AppendManyNotes(std::vector<KeywordNote>* notes);

}  // namespace lyrefit::python
