#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "keywords.h"

namespace lyrefit::python {

// Documentation of a verb for help() and the stubs. The signature and the list of its keywords come
// from the option tables.
struct VerbText {
  std::string name;
  std::string arguments;  // "curve, current=None"
  std::string head;       // its purpose and its arguments, in numpydoc format
  std::string end;        // its return value and exceptions
  std::vector<KeywordNote> keywords;
  bool promised = false;  // within a major version (data/stable); false: experimental
};

// Keeps the first of several notes with the same name, since tables share options.
std::vector<KeywordNote> EachOnce(const std::vector<KeywordNote>& notes);

// The docstring, with the signature in the format of inspect.
std::string DocOf(const VerbText& verb);

// Stores the keywords for the stubs: _keywords() of the module.
void Note(pybind11::module_* module, const VerbText& verb);

// Adds the function of a verb to the module. `extra` are its py::arg.
template <class Function, class... Extra>
void DefineVerb(pybind11::module_* module, const VerbText& verb, Function&& function,
                const Extra&... extra) {
  Note(module, verb);
  module->def(verb.name.c_str(), std::forward<Function>(function), extra..., DocOf(verb).c_str());
}

}  // namespace lyrefit::python
