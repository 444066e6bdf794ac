#include "columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "errors.h"
#include "lyrefit/base/number_text.h"
#include "result.h"

namespace lyrefit::python {
namespace {

struct ColumnNames {
  Column column;
  std::array<std::string_view, 4> spellings;  // in lower case; errors use the first
};
constexpr ColumnNames kColumns[] = {
    {Column::kVoltage, {"voltage", "v", "voltage_v", "volts"}},
    {Column::kCurrent, {"current", "i", "current_a", "amps"}},
    {Column::kSigma, {"sigma", "sigma_a"}},
    {Column::kTime, {"time", "time_s"}},
    {Column::kSweep, {"sweep"}},
    {Column::kIrradiance,
     {"irradiance", "irradiance_wm2", "irradiance_w_m2", "effective_irradiance"}},
    {Column::kTemperature, {"temperature", "temperature_c", "temp_cell", "cell_temperature"}},
    {Column::kCells, {"cells_in_series"}},
    {Column::kCurve, {"curve", "curve_id", "id"}},
};

const ColumnNames& NamesOf(Column column) {
  return *std::find_if(std::begin(kColumns), std::end(kColumns),
                       [column](const ColumnNames& names) { return names.column == column; });
}

py::object HeadOf(py::handle table) {
  return IsFrame(table) ? table.attr("columns") : py::object(table.attr("keys")());
}

const char* NameOf(Column column) { return NamesOf(column).spellings[0].data(); }

std::vector<double> Needed(py::handle table, Column column) {
  const py::object values = ColumnOf(table, column);
  if (!values.is_none()) return NumbersOf(NameOf(column), values);
  Raise({std::string("expected a column '") + NameOf(column) + "' or '" +
             std::string(NamesOf(column).spellings[1]) + "', found " +
             py::str(py::list(HeadOf(table))).cast<std::string>(),
         {}});
}

// The column if it exists; a single number applies to all rows.
std::vector<double> Beside(py::handle table, Column column, std::size_t rows) {
  const py::object values = ColumnOf(table, column);
  if (values.is_none()) return {};
  const bool one = PyFloat_Check(values.ptr()) != 0 || PyLong_Check(values.ptr()) != 0;
  if (one) return std::vector<double>(rows, values.cast<double>());
  std::vector<double> numbers = NumbersOf(NameOf(column), values);
  if (numbers.size() != rows) {
    Raise({"expected " + std::to_string(rows) + " values of " + NameOf(column) + ", found " +
               std::to_string(numbers.size()),
           {}});
  }
  return numbers;
}

bool IsMasked(py::handle values) {
  return py::isinstance<py::array>(values) && py::hasattr(values, "filled");
}

}  // namespace

bool IsFrame(py::handle value) {
  return py::hasattr(value, "columns") && py::hasattr(value, "iloc");
}

bool IsTable(py::handle value) {
  if (py::isinstance<Result>(value)) return false;
  return py::isinstance<py::dict>(value) || IsFrame(value) ||
         (py::hasattr(value, "keys") && py::hasattr(value, "__getitem__"));
}

bool IsGroupBy(py::handle value) {
  return py::hasattr(value, "ngroups") && py::hasattr(value, "__iter__");
}

py::dict FramesOf(py::handle groups) {
  return py::dict(py::list(py::reinterpret_borrow<py::object>(groups)));
}

py::object ColumnOf(py::handle table, Column column) {
  const auto& spellings = NamesOf(column).spellings;
  for (const py::handle key : HeadOf(table)) {
    if (!py::isinstance<py::str>(key)) continue;
    const std::string lower = LowerCase(key.cast<std::string>());
    const auto found = std::find(spellings.begin(), spellings.end(), lower);
    if (!lower.empty() && found != spellings.end()) return table[key];
  }
  return py::none();
}

IvCurve ReadingsOf(py::handle table) {
  IvCurve readings;
  readings.voltage_V = Needed(table, Column::kVoltage);
  readings.current_A = Needed(table, Column::kCurrent);
  const std::size_t rows = readings.voltage_V.size();
  readings.sigma_A = Beside(table, Column::kSigma, rows);
  readings.time_s = Beside(table, Column::kTime, rows);
  readings.irradiance_W_m2 = Beside(table, Column::kIrradiance, rows);
  readings.temperature_C = Beside(table, Column::kTemperature, rows);
  const std::vector<double> sweep = Beside(table, Column::kSweep, rows);
  readings.sweep.assign(sweep.begin(), sweep.end());
  return readings;
}

IvCurve RowsOf(const IvCurve& all, const std::vector<std::size_t>& rows) {
  IvCurve picked;
  const auto pick = [&rows](const auto& from, auto* to) {
    if (from.empty()) return;
    to->reserve(rows.size());
    for (const std::size_t row : rows) to->push_back(from[row]);
  };
  pick(all.voltage_V, &picked.voltage_V);
  pick(all.current_A, &picked.current_A);
  pick(all.sigma_A, &picked.sigma_A);
  pick(all.time_s, &picked.time_s);
  pick(all.sweep, &picked.sweep);
  pick(all.irradiance_W_m2, &picked.irradiance_W_m2);
  pick(all.temperature_C, &picked.temperature_C);
  return picked;
}

std::vector<double> NumbersOf(const char* name, py::handle values) {
  if (IsMasked(values)) {
    const py::object numbers = values.attr("astype")("float64");
    return NumbersOf(name, numbers.attr("filled")(std::numeric_limits<double>::quiet_NaN()));
  }
  py::array array = py::array::ensure(values);
  if (!array) PyErr_Clear();
  const bool known =
      array && (std::string_view("iuf").find(array.dtype().kind()) != std::string_view::npos ||
                array.size() == 0 || array.dtype().kind() == 'O');
  const auto numbers =
      known ? py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array)
            : py::array_t<double, py::array::c_style | py::array::forcecast>();
  if (!known || !numbers) {
    PyErr_Clear();
    Raise({std::string(name) + ": expected an array of numbers, found " +
               py::str(py::type::handle_of(values).attr("__name__")).cast<std::string>() +
               (array ? " of " + py::str(array.dtype()).cast<std::string>() : std::string()),
           {}});
  }
  if (numbers.ndim() != 1) {
    Raise({std::string(name) + ": expected one dimension, found shape " +
               py::str(array.attr("shape")).cast<std::string>(),
           {}});
  }
  return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
}

py::array_t<double> ViewOf(const std::vector<double>& values, py::handle owner) {
  py::array_t<double> view(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

py::array_t<double> ArrayOf(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace lyrefit::python
