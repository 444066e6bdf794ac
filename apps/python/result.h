#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/json.h"

namespace lyrefit::python {

namespace py = pybind11;

// How a record shows itself: what the command writes of it under --json, as text, as --brief, --csv
// and --html. Each is made when it is asked for and not before; nothing of Python's is in them.
struct Record {
  std::function<std::string(JsonPoints points)> json;
  std::function<std::string()> text;
  std::function<std::string()> brief;
  std::function<Document()> document;
  std::function<std::string()> csv = {};                             // none: it has no table
  std::function<Expected<void>(const std::string& file)> plot = {};  // none: it has no picture
};

// What a verb gives: a mapping of what stands in the JSON, read from that very text by Python's own
// json when first asked for. Verbs derive from it what more there is to ask of theirs.
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

// For the class of what never changes: it is its own copy. It stays in its process, and says what
// can be sent to others in its place.
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
