#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "lyrefit/read/spreadsheet_text.h"

// pandas frames of results; pandas is imported at the first call.
namespace lyrefit::python {

// A frame from CSV text, with all digits and texts unchanged; empty fields become NaN.
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

// A frame from a list of dicts, one for each row.
inline pybind11::object FrameOfRows(const pybind11::handle& rows) {
  return pybind11::module_::import("pandas").attr("DataFrame")(rows);
}

}  // namespace lyrefit::python
