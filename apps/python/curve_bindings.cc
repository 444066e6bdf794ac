#include <pybind11/stl.h>

#include "bindings.h"
#include "curves.h"
#include "docs.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/read/write_curve.h"
#include "result.h"
#include "work.h"

namespace lyrefit::python {
namespace {

constexpr char kCurveDoc[] =
    "Curve(voltage, current=None, /, *, cells_in_series=None, temperature_C=None, "
    "irradiance_Wm2=None, name=None, **options)\n--\n\n"
    "One measured curve in generator sign, in the order its points were taken.\n\n"
    "Every verb takes one in the place of arrays. What nobody stated has a usual value, and\n"
    "`assumptions` says so.\n\n"
    "Parameters\n----------\n"
    "voltage : array_like of shape (n,), path, mapping or DataFrame\n"
    "    In volt, or what :func:`read_curve` reads, or a table with the columns v and i.\n"
    "current : array_like of shape (n,), optional\n"
    "    In ampere, positive where the device delivers.\n"
    "cells_in_series : int, optional\n"
    "temperature_C : float, optional\n"
    "    Of the cells, in degrees Celsius.\n"
    "irradiance_Wm2 : float, optional\n"
    "bypass_diodes : int, optional\n"
    "    Of the whole device (experimental: may change in a minor version).\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    Where there is no curve in it.\n";

constexpr char kReadCurveDoc[] =
    "Read one measured curve from a file or folder.\n\n"
    "Tables of most instruments (CSV and text, any usual separator, encoding and header), JSON\n"
    "with lists of voltages and currents, pandas' tables as JSON, ivcurves files, and a folder\n"
    "that holds curve.csv. NAME.json beside NAME.csv gives conditions; keywords go before it.\n\n"
    "Parameters\n----------\n"
    "path : str or os.PathLike\n"
    "    A text with line breaks is taken for the table itself.\n";

constexpr char kReadCurveEnd[] =
    "Returns\n-------\n"
    "Curve\n\n"
    "Raises\n------\n"
    "lyrefit.Error\n"
    "    With file, line and column.\n";

IvCurve MakeCurve(py::handle voltage, py::handle current, const py::kwargs& given) {
  Keywords keywords("Curve", given);
  IvCurve curve = TakeCurve(voltage, current, &keywords);
  keywords.Finish();
  return curve;
}

IvCurve ReadOne(py::handle path, const py::kwargs& given) {
  Keywords keywords("read_curve", given);
  const CurveKeywords said = ReadCurveKeywords(&keywords);
  keywords.Finish();
  if (!IsPath(path)) throw py::type_error("read_curve() expects a path or a text");
  return CurveOf(path, py::none(), said);
}

// An array of the values; None if there are none.
py::object Optional(const std::vector<double>& values, py::handle owner) {
  return values.empty() ? py::object(py::none()) : ViewOf(values, owner);
}

py::object FrameOfCurve(const py::object& self) {
  const auto& curve = self.cast<const IvCurve&>();
  py::dict columns;
  columns["voltage"] = ArrayOf(curve.voltage_V);
  columns["current"] = ArrayOf(curve.current_A);
  if (!curve.sigma_A.empty()) columns["sigma"] = ArrayOf(curve.sigma_A);
  if (!curve.time_s.empty()) columns["time"] = ArrayOf(curve.time_s);
  if (!curve.sweep.empty()) columns["sweep"] = curve.sweep;
  return py::module_::import("pandas").attr("DataFrame")(columns);
}

std::string DescribeCurve(const IvCurve& curve) {
  return "<lyrefit.Curve '" + curve.name + "', " + std::to_string(curve.size()) + " points, " +
         std::to_string(curve.conditions.cells_in_series) + " cells>";
}

template <std::vector<double> IvCurve::*kColumn>
py::object ColumnOf(const py::object& self) {
  return Optional(self.cast<const IvCurve&>().*kColumn, self);
}

}  // namespace

void BindCurve(py::module_* module) {
  py::class_<IvCurve, std::shared_ptr<IvCurve>> type(*module, "Curve", kCurveDoc);
  NeverChanges(&type, "frame() or csv");
  type.def(py::init(&MakeCurve), py::arg("voltage"), py::arg("current") = py::none())
      .def("__len__", &IvCurve::size)
      .def("__repr__", &DescribeCurve)
      .def_readonly("name", &IvCurve::name, "str: what reports call it.")
      .def_readonly("source", &IvCurve::source, "str: the file it was read from, or ''.")
      .def_property_readonly(
          "voltage",
          [](const py::object& self) {
            return ViewOf(self.cast<const IvCurve&>().voltage_V, self);
          },
          "numpy.ndarray of shape (n,): volt; a view, not to be written.")
      .def_property_readonly(
          "current",
          [](const py::object& self) {
            return ViewOf(self.cast<const IvCurve&>().current_A, self);
          },
          "numpy.ndarray of shape (n,): ampere; a view, not to be written.")
      .def_property_readonly("sigma", &ColumnOf<&IvCurve::sigma_A>,
                             "numpy.ndarray or None: standard deviation of each current in A.")
      .def_property_readonly("time", &ColumnOf<&IvCurve::time_s>,
                             "numpy.ndarray or None: when each was taken, in s.")
      .def_property_readonly("irradiance", &ColumnOf<&IvCurve::irradiance_W_m2>,
                             "numpy.ndarray or None: W/m2 at each reading.")
      .def_property_readonly("temperature", &ColumnOf<&IvCurve::temperature_C>,
                             "numpy.ndarray or None: degrees Celsius at each reading.")
      .def_property_readonly(
          "sweep",
          [](const IvCurve& curve) {
            return curve.sweep.empty() ? py::object(py::none()) : py::cast(curve.sweep);
          },
          "list of int or None: which sweep each belongs to.")
      .def_property_readonly(
          "cells_in_series", [](const IvCurve& curve) { return curve.conditions.cells_in_series; },
          "int")
      .def_property_readonly(
          "strings_in_parallel",
          [](const IvCurve& curve) { return curve.conditions.strings_in_parallel; }, "int")
      .def_property_readonly(
          "temperature_C",
          [](const IvCurve& c) { return c.conditions.cell_temperature_K - kZeroCelsius_K; },
          "float: of the cells, in degrees Celsius.")
      .def_property_readonly(
          "irradiance_Wm2", [](const IvCurve& c) { return c.conditions.irradiance_W_m2; },
          "float: in W/m2.")
      .def_property_readonly(
          "assumptions", [](const IvCurve& curve) { return SentencesOf(curve.assumptions); },
          "list of str: what nobody said and what was assumed.")
      .def_property_readonly(
          "csv", [](const IvCurve& curve) { return CurveToCsv(curve); },
          "str: as a table, with all digits.")
      .def_property_readonly(
          "sidecar", [](const IvCurve& curve) { return CurveSidecarJson(curve); },
          "str: the JSON that stands beside the table, with the conditions.")
      .def("frame", &FrameOfCurve,
           "frame($self)\n--\n\nThe readings as a pandas.DataFrame, a row a reading.");
  std::vector<KeywordNote> notes;
  AppendCurveNotes(&notes);
  DefineVerb(module, {"read_curve", "path", kReadCurveDoc, kReadCurveEnd, notes, true}, &ReadOne,
             py::arg("path"));
  Note(module, {"Curve", "voltage, current=None", "", "", notes});
}

}  // namespace lyrefit::python
