#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

#include "lyrefit/curve/iv_curve.h"

// Conversion of tables (pandas frames and mappings of columns) and arrays.
namespace lyrefit::python {

namespace py = pybind11;

// Columns of a table. Each has a few names, in any case: V, voltage, voltage_V; i, current,
// current_A; sigma; time; sweep; irradiance, irradiance_Wm2; temperature, temperature_C;
// cells_in_series; curve, curve_id, id.
enum class Column {
  kVoltage,
  kCurrent,
  kSigma,
  kTime,
  kSweep,
  kIrradiance,
  kTemperature,
  kCells,
  kCurve,
};

bool IsFrame(py::handle value);
bool IsTable(py::handle value);  // a frame, or a mapping other than a Result

// Whether `value` is a DataFrame.groupby: pairs of an id and a frame.
bool IsGroupBy(py::handle value);
py::dict FramesOf(py::handle groups);  // by id

// The column, or None.
py::object ColumnOf(py::handle table, Column column);

// The readings of a table, row by row and unchecked, with its other columns. A number instead of a
// column applies to every reading.
IvCurve ReadingsOf(py::handle table);

// The selected rows of `all`.
IvCurve RowsOf(const IvCurve& all, const std::vector<std::size_t>& rows);

// One-dimensional numbers of any type as doubles, NaN where they are masked; `name` is for errors.
std::vector<double> NumbersOf(const char* name, py::handle values);

// A read-only array of the values without a copy: `owner` keeps them alive.
py::array_t<double> ViewOf(const std::vector<double>& values, py::handle owner);
// An array with a copy of the values.
py::array_t<double> ArrayOf(const std::vector<double>& values);

}  // namespace lyrefit::python
