#include <glog/logging.h>

#include "bindings.h"
#include "lyrefit/base/version.h"

namespace lyrefit::python {

PYBIND11_MODULE(_lyrefit, module) {
  // The solver logs every step it had to take back as an error; the report says what came of it.
  FLAGS_minloglevel = google::GLOG_FATAL;
  FLAGS_logtostderr = true;
  // Docstrings begin with signatures of their own.
  py::options options;
  options.disable_function_signatures();
  module.doc() = "The compiled part of lyrefit.";
  module.attr("__version__") = Version();
  BindErrors(&module);
  BindResult(&module);
  BindCurve(&module);
  BindEffects(&module);
  BindFit(&module);
  BindFitMany(&module);
  BindSimulate(&module);
  BindFamily(&module);
  BindDataSheet(&module);
  BindDiagnose(&module);
  BindTranslate(&module);
  BindCertify(&module);
  BindStudy(&module);
  BindPvlib(&module);
}

}  // namespace lyrefit::python
