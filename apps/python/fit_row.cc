#include "fit_row.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/batch/batch_task.h"

namespace lyrefit::python {
namespace {

namespace py = pybind11;

// The numeric columns of every frame, before and after those of the parameters.
constexpr const char* kConditionColumns[] = {"points", "cells_in_series", "temperature_C",
                                             "irradiance_Wm2"};
constexpr const char* kAnswerColumns[] = {"nNsVth",
                                          "i_sc",
                                          "v_oc",
                                          "i_mp",
                                          "v_mp",
                                          "p_mp",
                                          "ff",
                                          "rmse_solved_current",
                                          "rmse_measured_current"};

void AddKeyPoints(const KeyPoints& points, std::map<std::string, double>* numbers) {
  numbers->insert({{"i_sc", points.short_circuit_current_A},
                   {"v_oc", points.open_circuit_voltage_V},
                   {"i_mp", points.max_power_current_A},
                   {"v_mp", points.max_power_voltage_V},
                   {"p_mp", points.max_power_W},
                   {"ff", points.fill_factor}});
}

// Parameters of effects have no pvlib name and use their symbol.
std::string ColumnOf(const ParameterInfo& info) {
  return info.name.empty() ? info.symbol : info.name;
}

// The parameters of all rows, in the order of the largest model.
std::vector<std::string> ParameterColumns(const std::vector<FitRow>& rows) {
  std::vector<std::string> names;
  for (const FitRow& row : rows) {
    for (const std::string& name : row.parameters) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

py::array_t<double> NumberColumn(const std::vector<FitRow>& rows, const std::string& name) {
  py::array_t<double> column(static_cast<py::ssize_t>(rows.size()));
  double* value = column.mutable_data();
  for (const FitRow& row : rows) {
    const auto found = row.numbers.find(name);
    *value++ = found == row.numbers.end() ? kUnknown : found->second;
  }
  return column;
}

py::list TextColumn(const std::vector<FitRow>& rows, std::string FitRow::*text) {
  py::list column;
  for (const FitRow& row : rows) column.append(row.*text);
  return column;
}

}  // namespace

FitRow RowOf(const std::string& id, const FitReport& report) {
  FitRow row{id,
             ToText(report.usable ? RowStatus::kFine : RowStatus::kNotUsable),
             report.not_usable_because,
             ToText(report.model),
             "",
             {},
             {}};
  for (const std::string& warning : report.warnings) {
    row.warnings += (row.warnings.empty() ? "" : "; ") + warning;
  }
  const Conditions& conditions = report.curve.conditions;
  row.numbers = {{"points", static_cast<double>(report.curve.size())},
                 {"cells_in_series", conditions.cells_in_series},
                 {"temperature_C", conditions.cell_temperature_K - kZeroCelsius_K},
                 {"irradiance_Wm2", conditions.irradiance_W_m2},
                 {"nNsVth", report.nNsVth}};
  for (const Estimate& estimate : report.estimates) {
    const std::string name = ColumnOf(estimate.info);
    row.parameters.push_back(name);
    row.numbers[name] = report.polished ? estimate.refined : estimate.searched;
    row.numbers[name + "_se"] = estimate.standard_error;
  }
  AddKeyPoints(report.simulated, &row.numbers);
  const RmsePair& rmse = report.polished ? report.rmse.refined : report.rmse.searched;
  row.numbers["rmse_solved_current"] = rmse.solved_current_A;
  row.numbers["rmse_measured_current"] = rmse.measured_current_A;
  return row;
}

FitRow BrokenRow(const std::string& id, const Error& error) {
  return {id, ToText(RowStatus::kBroken), error.ToString(), "", "", {}, {}};
}

py::object FrameOf(const std::vector<FitRow>& rows) {
  py::dict columns;
  columns["id"] = TextColumn(rows, &FitRow::id);
  columns["status"] = TextColumn(rows, &FitRow::status);
  columns["reason"] = TextColumn(rows, &FitRow::reason);
  columns["model"] = TextColumn(rows, &FitRow::model);
  for (const char* name : kConditionColumns) columns[name] = NumberColumn(rows, name);
  for (const std::string& name : ParameterColumns(rows)) {
    columns[py::str(name)] = NumberColumn(rows, name);
    columns[py::str(name + "_se")] = NumberColumn(rows, name + "_se");
  }
  for (const char* name : kAnswerColumns) columns[name] = NumberColumn(rows, name);
  columns["warnings"] = TextColumn(rows, &FitRow::warnings);
  return py::module_::import("pandas").attr("DataFrame")(columns);
}

}  // namespace lyrefit::python
