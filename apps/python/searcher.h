#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "lyrefit/search/search_summary.h"
#include "own_call.h"

namespace lyrefit::python {

// Wraps a Python search: search(objective, lower, upper, options). `fault` stores its exceptions.
// Within the budget, a search that asks for more evaluations is ended (StopIteration is raised in
// it), and the best point it asked for is its answer.
SearchFunction SearcherOf(pybind11::object search, std::shared_ptr<Fault> fault,
                          bool within_budget = false);

// The name of a function or of the class of an object that can be called.
std::string NameOf(pybind11::handle function);

}  // namespace lyrefit::python
