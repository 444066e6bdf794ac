#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "lyrefit/report/csv.h"

// pandas frames of what was found; pandas is asked for when one is wanted, and not before.
namespace lyrefit::python {

// A table in the text of CSV, with all digits and texts as they are; what is empty is NaN.
inline pybind11::object FrameOfCsv(const std::string& csv) {
  const pybind11::object text = pybind11::module_::import("io").attr("StringIO")(csv);
  const pybind11::object frame = pybind11::module_::import("pandas").attr("read_csv")(
      text, pybind11::arg("float_precision") = "round_trip");
  const pybind11::cpp_function plain([](const pybind11::object& cell) -> pybind11::object {
    if (!pybind11::isinstance<pybind11::str>(cell)) return cell;
    return pybind11::str(WithoutApostrophe(pybind11::cast<std::string>(cell)));
  });
  for (const pybind11::handle column : frame.attr("columns")) {
    const pybind11::object cells = frame.attr("__getitem__")(column);
    const std::string kind = pybind11::str(cells.attr("dtype"));
    if (kind == "object" || kind == "str" || kind == "string") {
      frame.attr("__setitem__")(column, cells.attr("map")(plain));
    }
  }
  return frame;
}

// A list of dicts, a row each.
inline pybind11::object FrameOfRows(const pybind11::handle& rows) {
  return pybind11::module_::import("pandas").attr("DataFrame")(rows);
}

}  // namespace lyrefit::python
