#include "bindings.h"
#include "errors.h"
#include "lyrefit/cite/cite.h"
#include "result.h"

namespace lyrefit::python {
namespace {

constexpr char kCiteDoc[] =
    "cite(report=None)\n--\n\n"
    "BibTeX of what a report used: software, searches, models, effects, tests, standards.\n\n"
    "Experimental: may change in a minor version.\n\n"
    "Parameters\n----------\n"
    "report : result of a verb, or mapping, optional\n"
    "    Of a mapping the content of the command's JSON. Without it what nearly every fit uses.\n\n"
    "Returns\n-------\n"
    "str\n"
    "    A line ``% missing: ...`` names fields that no source at hand states.\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    A mapping that is no report's.\n\n"
    "Examples\n--------\n"
    ">>> print(lyrefit.cite(lyrefit.fit(\"data/rtc_france\")))\n";

std::string CiteOne(py::handle report) {
  if (report.is_none()) return CiteMethods();
  std::string json;
  if (py::isinstance<Result>(report)) {
    json = report.cast<const Result&>().Json();
  } else if (py::hasattr(report, "keys")) {
    json = py::module_::import("json")
               .attr("dumps")(py::dict(report.attr("items")()))
               .cast<std::string>();
  } else {
    Raise({"report: expected a result or a mapping", {}});
  }
  return Must(CiteReport(json, "report"));
}

}  // namespace

void BindCite(py::module_* module) {
  module->def("cite", &CiteOne, py::arg("report") = py::none(), kCiteDoc);
}

}  // namespace lyrefit::python
