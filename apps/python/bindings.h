#pragma once

#include <pybind11/pybind11.h>

// Each function adds the functions and types of one library module to the Python module. Most are
// defined in MODULE_bindings.cc.
namespace lyrefit::python {

namespace py = pybind11;

void BindErrors(py::module_* module);
void BindResult(py::module_* module);
void BindCurve(py::module_* module);
void BindFit(py::module_* module);
void BindFitMany(py::module_* module);
void BindSimulate(py::module_* module);
void BindCell(py::module_* module);
void BindTrend(py::module_* module);
void BindFamily(py::module_* module);
void BindDataSheet(py::module_* module);
void BindDiagnose(py::module_* module);
void BindTranslate(py::module_* module);
void BindCertify(py::module_* module);
void BindStudy(py::module_* module);
void BindAudit(py::module_* module);
void BindEffects(py::module_* module);
void BindCite(py::module_* module);
void BindPvlib(py::module_* module);
void BindCommand(py::module_* module);  // in wheels only

}  // namespace lyrefit::python
