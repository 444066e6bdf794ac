#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "errors.h"
#include "lyrefit/family/family_documents.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/report/json.h"

namespace lyrefit::python {

// Output of --pvlib for a device: pvlib's function and its keywords, and the row of SAM's library.
inline pybind11::object PvlibDict(const std::string& name, const Translation& translation,
                                  const std::vector<double>& shared,
                                  const std::string& technology) {
  const auto keywords = Must(PvlibParameters(translation, shared));
  const auto row = CecRow(translation, shared, name, technology);
  return pybind11::module_::import("json").attr("loads")(
      PvlibJson(name, translation.spec.law, keywords, row));
}

}  // namespace lyrefit::python
