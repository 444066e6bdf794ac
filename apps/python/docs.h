#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "keywords.h"

namespace lyrefit::python {

// A verb as help() and the stubs show it: the signature and the list of its keywords come from the
// option tables.
struct VerbText {
  std::string name;
  std::string arguments;  // "curve, current=None"
  std::string head;       // what it does, and its arguments, as numpydoc has it
  std::string end;        // what it returns and raises
  std::vector<KeywordNote> keywords;
};

// Of notes with the same name, which several tables share, the first.
std::vector<KeywordNote> EachOnce(const std::vector<KeywordNote>& notes);

// The docstring, with the signature in the form that inspect understands.
std::string DocOf(const VerbText& verb);

// Keeps the keywords for the stubs: _keywords() of the module.
void Note(pybind11::module_* module, const VerbText& verb);

// Adds the function of a verb to the module. `extra` are its py::arg.
template <class Function, class... Extra>
void DefineVerb(pybind11::module_* module, const VerbText& verb, Function&& function,
                const Extra&... extra) {
  Note(module, verb);
  module->def(verb.name.c_str(), std::forward<Function>(function), extra..., DocOf(verb).c_str());
}

}  // namespace lyrefit::python
