#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <map>
#include <string>
#include <vector>

#include "bindings.h"
#include "errors.h"
#include "lyrefit/family/fit_family.h"
#include "lyrefit/model/pvlib_parameters.h"
#include "lyrefit/model/single_diodes.h"
#include "work.h"

// Functions for lyrefit.pvlib; pvlib.py checks and broadcasts their arguments.
namespace lyrefit::python {
namespace {

using Numbers = py::array_t<double>;

DeviceColumn AsColumn(const Numbers& numbers) {
  return {numbers.data(), numbers.strides(0) / static_cast<py::ssize_t>(sizeof(double))};
}

// Devices from five or seven arrays of equal length, in the order of pvlib's arguments.
SingleDiodes DevicesOf(const std::vector<Numbers>& parameters) {
  SingleDiodes devices;
  devices.size = static_cast<std::size_t>(parameters[0].size());
  devices.photocurrent = AsColumn(parameters[0]);
  devices.saturation_current = AsColumn(parameters[1]);
  devices.resistance_series = AsColumn(parameters[2]);
  devices.resistance_shunt = AsColumn(parameters[3]);
  devices.nNsVth = AsColumn(parameters[4]);
  if (parameters.size() > 5) {
    devices.recombination = AsColumn(parameters[5]);
    devices.built_in_voltage = AsColumn(parameters[6]);
  }
  return devices;
}

Numbers KeyPointTable(const std::vector<Numbers>& parameters) {
  const SingleDiodes devices = DevicesOf(parameters);
  const auto count = static_cast<py::ssize_t>(devices.size);
  Numbers table({py::ssize_t{7}, count});
  double* row[7];
  for (py::ssize_t k = 0; k < 7; ++k) row[k] = table.mutable_data() + k * count;
  Unlocked([&] {
    KeyPointsOf(devices, {row[0], row[1], row[2], row[3], row[4], row[5], row[6]});
    return 0;
  });
  return table;
}

using SolveMany = void (*)(const SingleDiodes&, const DeviceColumn&, double*);
Numbers Solved(SolveMany solve, const Numbers& given, const std::vector<Numbers>& parameters) {
  const SingleDiodes devices = DevicesOf(parameters);
  Numbers answer(given.size());
  double* out = answer.mutable_data();
  const DeviceColumn at = AsColumn(given);
  Unlocked([&] {
    solve(devices, at, out);
    return 0;
  });
  return answer;
}

std::vector<double> CopyOf(const Numbers& numbers) {
  const auto values = numbers.unchecked<1>();
  std::vector<double> copy;
  for (py::ssize_t k = 0; k < values.shape(0); ++k) copy.push_back(values(k));
  return copy;
}

// A curve under stated conditions without readings.
IvCurve CurveUnder(py::ssize_t number, double irradiance_W_m2, double temperature_C, int cells) {
  IvCurve curve;
  curve.name = std::to_string(number);
  curve.conditions.cells_in_series = cells;
  curve.conditions.irradiance_W_m2 = irradiance_W_m2;
  curve.conditions.cell_temperature_K = temperature_C + kZeroCelsius_K;
  return curve;
}

CurveSet MakeSet(const std::vector<Numbers>& voltages, const std::vector<Numbers>& currents,
                 const Numbers& irradiance_W_m2, const Numbers& temperature_C, int cells) {
  CurveSet set;
  set.name = "ivcurves";
  for (std::size_t k = 0; k < voltages.size(); ++k) {
    const auto row = static_cast<py::ssize_t>(k);
    set.curves.push_back(CurveUnder(row, irradiance_W_m2.at(row), temperature_C.at(row), cells));
    set.curves.back().voltage_V = CopyOf(voltages[k]);
    set.curves.back().current_A = CopyOf(currents[k]);
  }
  return set;
}

// A matrix of key points: irradiance, temperature, Isc, Voc, Imp and Vmp of each condition; NaN:
// not measured.
CurveSet MatrixOf(const std::vector<Numbers>& columns, int cells) {
  CurveSet set;
  set.name = "matrix";
  for (py::ssize_t k = 0; k < columns[0].size(); ++k) {
    KeyPoints points;
    points.short_circuit_current_A = columns[2].at(k);
    points.open_circuit_voltage_V = columns[3].at(k);
    points.max_power_current_A = columns[4].at(k);
    points.max_power_voltage_V = columns[5].at(k);
    points.max_power_W = points.max_power_current_A * points.max_power_voltage_V;
    set.curves.push_back(CurveUnder(k, columns[0].at(k), columns[1].at(k), cells));
    TakeKeyPoints(points, &set.curves.back());
  }
  return set;
}

// The shared parameters; for every curve also its individual device and whether it agrees with the
// others.
py::dict FamilyAnswer(const FamilyReport& report) {
  py::dict shared;
  for (const NamedValue& value : Must(PvlibParameters(report.translation, report.refined))) {
    shared[py::str(value.name)] = value.value;
  }
  const auto curves = static_cast<py::ssize_t>(report.curves.size());
  Numbers devices({curves, py::ssize_t{5}});
  py::array_t<bool> belongs(curves);
  for (py::ssize_t k = 0; k < curves; ++k) {
    const FamilyCurve& curve = report.curves[static_cast<std::size_t>(k)];
    for (py::ssize_t j = 0; j < 5; ++j) {
      devices.mutable_at(k, j) =
          curve.parameters.size() == 5 ? curve.parameters[static_cast<std::size_t>(j)] : kUnknown;
    }
    belongs.mutable_at(k) = curve.role == CurveRole::kFitted && !curve.outlier;
  }
  py::dict answer;
  answer["shared"] = shared;
  answer["devices"] = devices;
  answer["belongs"] = belongs;
  answer["warnings"] = report.warnings;
  answer["usable"] = report.usable;
  return answer;
}

// PVsyst's shared parameters behind a matrix of key points.
py::dict FitMatrix(const std::vector<Numbers>& columns, int cells,
                   const std::map<std::string, double>& fixed) {
  const CurveSet set = MatrixOf(columns, cells);
  FamilyOptions options;
  options.law = TranslationLaw::kPvsyst;
  options.fixed = fixed;
  options.intervals = options.random_baseline = false;
  options.folds = 0;
  return FamilyAnswer(Must(Work(
      py::none(), [&](const Observer& observer) { return FitFamily(set, options, observer); })));
}

py::dict FitDeSoto(const std::vector<Numbers>& voltages, const std::vector<Numbers>& currents,
                   const Numbers& irradiance_W_m2, const Numbers& temperature_C, int cells,
                   const std::map<std::string, double>& fixed) {
  const CurveSet set = MakeSet(voltages, currents, irradiance_W_m2, temperature_C, cells);
  FamilyOptions options;
  options.fixed = fixed;
  options.intervals = options.individual_fits = options.random_baseline = false;
  options.folds = 0;
  return FamilyAnswer(Must(Work(
      py::none(), [&](const Observer& observer) { return FitFamily(set, options, observer); })));
}

}  // namespace

void BindPvlib(py::module_* module) {
  module->def("_single_diode_points", &KeyPointTable);
  module->def("_current_at", [](const Numbers& voltage, const std::vector<Numbers>& parameters) {
    return Solved(CurrentsAt, voltage, parameters);
  });
  module->def("_voltage_at", [](const Numbers& current, const std::vector<Numbers>& parameters) {
    return Solved(VoltagesAt, current, parameters);
  });
  module->def("_fit_desoto", &FitDeSoto);
  module->def("_fit_matrix", &FitMatrix);
}

}  // namespace lyrefit::python
