#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>
#include <vector>

#include "keywords.h"
#include "lyrefit/curve/iv_curve.h"

namespace lyrefit::python {

// One of many curves, possibly not read yet. `read` uses no Python objects.
struct CurveToFit {
  std::string id;
  std::string file;  // published bounds are beside it; empty: none
  std::function<Expected<IvCurve>()> read;
};

// Accepted arguments of verbs on many curves:
//   - voltage and current as two arrays of shape (m, n), one curve per row, padded with NaN;
//     voltage
//     may have the shape (n,) for all of them,
//   - a list, or a mapping by id, of arguments for single curves,
//   - a long DataFrame, one reading per row, with the columns of `group` as curve id; the columns
//     cells_in_series, temperature_C and irradiance_Wm2 give the conditions,
//   - the path of a folder or file with many curves, as for the command's batch.
// Reads the keywords group, ids, and those of one curve, of which the conditions may be arrays of
// shape (m,).
std::vector<CurveToFit> TakeManyCurves(py::handle curves, py::handle current, Keywords* keywords);

void AppendManyNotes(std::vector<KeywordNote>* notes);

}  // namespace lyrefit::python
