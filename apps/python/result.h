#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/json.h"

namespace lyrefit::python {

namespace py = pybind11;

// Output functions of a record: --json, text, --brief, --csv and --html of the command. Each output
// is computed on request; none uses Python objects.
struct Record {
  std::function<std::string(JsonPoints points)> json;
  std::function<std::string(Length)> text;
  std::function<std::string()> brief;
  std::function<Document()> document;
  std::function<std::string()> csv = {};  // empty: no table
  using Plot = std::function<Expected<void>(const std::string& file)>;
  Plot plot = {};         // empty: no picture
  Plot convergence = {};  // of searches; empty: none
};

// Result of a verb: a mapping with the content of the JSON text, which Python's json parses at the
// first access. Verbs derive classes with further members.
class Result {
 public:
  explicit Result(Record record) : record_(std::move(record)) {}

  const std::string& Json() const;
  std::string FullJson() const { return record_.json(JsonPoints::kAll); }
  const py::dict& Dictionary() const;
  const Record& record() const { return record_; }

 private:
  Record record_;
  mutable std::string json_;
  mutable py::object dictionary_;
};

// For immutable classes: a copy is the object itself. Pickling raises an error that names a
// replacement.
template <class Class>
void NeverChanges(Class* type, const char* instead) {
  type->def("__copy__", [](const py::object& self) { return self; })
      .def("__deepcopy__", [](const py::object& self, py::handle) { return self; })
      .def("__reduce__", [instead](const py::object& self) -> py::object {
        throw py::type_error("a " +
                             py::str(py::type::of(self).attr("__name__")).cast<std::string>() +
                             " cannot be pickled: send its " + instead + " in its place");
      });
}

}  // namespace lyrefit::python
