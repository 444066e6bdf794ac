#include <glog/logging.h>

#include "bindings.h"
#include "lyrefit/base/former_names.h"
#include "lyrefit/base/version.h"

namespace lyrefit::python {

PYBIND11_MODULE(_lyrefit, module) {
  // The solver logs every rejected step as an error; the report states the outcome.
  FLAGS_minloglevel = google::GLOG_FATAL;
  FLAGS_logtostderr = true;
  // The docstrings already start with signatures.
  py::options options;
  options.disable_function_signatures();
  module.doc() = "The compiled part of lyrefit.";
  module.attr("__version__") = Version();
  py::list former_keys;
  for (const FormerName& key : kFormerKeys)
    former_keys.append(py::make_tuple(key.former, key.name));
  module.attr("_former_keys") = former_keys;
  BindErrors(&module);
  BindResult(&module);
  BindCurve(&module);
  BindEffects(&module);
  BindFit(&module);
  BindFitMany(&module);
  BindSimulate(&module);
  BindCell(&module);
  BindTrend(&module);
  BindFamily(&module);
  BindDataSheet(&module);
  BindDiagnose(&module);
  BindTranslate(&module);
  BindCertify(&module);
  BindStudy(&module);
  BindAudit(&module);
  BindCite(&module);
  BindPvlib(&module);
#ifdef LYREFIT_WHEEL
  BindCommand(&module);
#endif
}

}  // namespace lyrefit::python
