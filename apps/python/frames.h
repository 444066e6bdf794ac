#pragma once

#include <pybind11/pybind11.h>

#include <string>

// pandas frames of what was found; pandas is asked for when one is wanted, and not before.
namespace lyrefit::python {

// A table in the text of CSV, with all digits; what is empty is NaN.
inline pybind11::object FrameOfCsv(const std::string& csv) {
  const pybind11::object text = pybind11::module_::import("io").attr("StringIO")(csv);
  return pybind11::module_::import("pandas").attr("read_csv")(
      text, pybind11::arg("float_precision") = "round_trip");
}

// A list of dicts, a row each.
inline pybind11::object FrameOfRows(const pybind11::handle& rows) {
  return pybind11::module_::import("pandas").attr("DataFrame")(rows);
}

}  // namespace lyrefit::python
