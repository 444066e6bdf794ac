#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "lyrefit/search/search_summary.h"
#include "own_call.h"

namespace lyrefit::python {

// Wraps a Python search: search(objective, lower, upper, options). `fault` stores its exceptions.
SearchFunction SearcherOf(pybind11::object search, std::shared_ptr<Fault> fault);

}  // namespace lyrefit::python
