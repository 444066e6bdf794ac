#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "curves.h"
#include "fit.h"
#include "lyrefit/devices/two_junction_options.h"

namespace lyrefit::python {

// Keywords of fit() about the junctions of the device.
struct JunctionKeywords {
  int junctions = 1;
  TwoJunctionOptions options;  // those that only two junctions have
};

// Reads `junctions` and the rows of kTwoJunctionOptionTable that a fit of one junction does not
// have. Raises for keywords that the number of junctions excludes.
JunctionKeywords ReadJunctionKeywords(Keywords* keywords);
void AppendJunctionNotes(std::vector<KeywordNote>* notes);

// fit() with junctions=2: a TwoJunctionResult of all curves together.
py::object FitTandem(py::handle curves, py::handle current, const CurveKeywords& said,
                     const FitKeywords& asked, const JunctionKeywords& junctions,
                     const py::object& progress);

// Adds the class TwoJunctionResult.
void BindTwoJunctions(py::module_* module);

}  // namespace lyrefit::python
