#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "lyrefit/search/search_summary.h"
#include "own_call.h"

namespace lyrefit::python {

// A search of Python's: search(objective, lower, upper, options). What it raises waits in `fault`.
SearchFunction SearcherOf(pybind11::object search, std::shared_ptr<Fault> fault);

}  // namespace lyrefit::python
