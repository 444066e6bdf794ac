#include "errors.h"

#include "bindings.h"

namespace lyrefit::python {
namespace {

constexpr char kErrorDoc[] =
    "A mistake in data, files or options, in one sentence that says what is wrong and what was\n"
    "expected.\n\n"
    "Attributes\n"
    "----------\n"
    "message : str\n"
    "    The sentence alone; str() of the error has the place before it.\n"
    "file : str\n"
    "    The file it is about; empty if there is none.\n"
    "line, column : int\n"
    "    Where in the file, from 1; 0 where it is tied to no line.\n";

py::handle error_type;  // owned by the module as well; never destroyed

}  // namespace

void Raise(const Error& error) {
  const py::object raised = error_type(error.ToString());
  raised.attr("message") = error.message;
  raised.attr("file") = error.file;
  raised.attr("line") = error.line;
  raised.attr("column") = error.column;
  PyErr_SetObject(error_type.ptr(), raised.ptr());
  throw py::error_already_set();
}

Error ErrorOf(py::error_already_set& raised) {
  if (!raised.matches(error_type)) throw;
  const py::object& error = raised.value();
  return {error.attr("message").cast<std::string>(), error.attr("file").cast<std::string>(),
          error.attr("line").cast<int>(), error.attr("column").cast<int>()};
}

void Warn(const std::string& sentence) {
  if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 1) != 0) throw py::error_already_set();
}

void WarnUnlessUsable(bool usable, const std::string& because) {
  if (usable) return;
  Warn("the fit is not usable: " + (because.empty() ? "its 'warnings' say why" : because));
}

void BindErrors(py::module_* module) {
  error_type = PyErr_NewExceptionWithDoc("lyrefit.Error", kErrorDoc, PyExc_ValueError, nullptr);
  if (!error_type) throw py::error_already_set();
  module->attr("Error") = error_type;
}

}  // namespace lyrefit::python
