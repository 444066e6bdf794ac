#include "plant/plan_task.h"

#include <Eigen/Core>
#include <cmath>
#include <utility>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/dense.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/curve/key_points.h"
#include "plant/scale.h"

namespace lyrefit {
namespace {

std::vector<ResultColumn> PlanColumns(bool planned) {
  constexpr CellType kNumber = CellType::kNumber;
  constexpr CellType kWhole = CellType::kWhole;
  std::vector<ResultColumn> columns = {
      {kSlopeColumn, "ohm", kNumber, "measured slope -dV/dI at open circuit"}};
  if (!planned) return columns;
  for (ResultColumn column : std::vector<ResultColumn>{
           {"plan_module", "", CellType::kText, "module of the string by the plan"},
           {"plan_modules_in_series", "", kWhole, "modules in series by the plan"},
           {"plan_strings_in_parallel", "", kWhole, "strings in parallel by the plan"},
           {"plan_bypass_diodes", "", kWhole, "bypass diodes of a module by the plan"},
           {"plan_cells_in_series", "", kWhole, "cells in series of the string by the plan"},
           {"plan_Isc_A", "A", kNumber,
            "short-circuit current that the plan expects at the stated light and temperature"},
           {"plan_Voc_V", "V", kNumber, "open-circuit voltage that the plan expects"},
           {"plan_Imp_A", "A", kNumber, "current at maximum power that the plan expects"},
           {"plan_Vmp_V", "V", kNumber, "voltage at maximum power that the plan expects"},
           {"plan_Pmax_W", "W", kNumber, "maximum power that the plan expects"},
           {"plan_slope_ohm", "ohm", kNumber,
            "slope -dV/dI at open circuit that the plan expects, without cables"}}) {
    columns.push_back(std::move(column));
  }
  return columns;
}

// The figures that the plan expects of a string; unknown without a module or conditions.
StringFigures ExpectedOf(const PlannedString& line, const IvCurve& curve) {
  const bool known = line.module && curve.irradiance_known && curve.temperature_known &&
                     curve.conditions.irradiance_W_m2 > 0;
  if (!known) return {};
  return FiguresByPlan(line, curve.conditions.irradiance_W_m2, curve.conditions.cell_temperature_K);
}

std::vector<ResultCell> PlanCells(const PlannedString* line, const IvCurve& curve) {
  std::vector<ResultCell> cells;
  if (line == nullptr) return std::vector<ResultCell>(PlanColumns(true).size() - 1);
  cells.push_back(line->module ? TextCell(line->module->name) : ResultCell());
  cells.emplace_back(std::int64_t{line->modules_in_series});
  cells.emplace_back(std::int64_t{line->strings_in_parallel});
  cells.emplace_back(std::int64_t{line->bypass_diodes});
  cells.push_back(line->module ? ResultCell(std::int64_t{line->modules_in_series} *
                                            line->module->cells_in_series)
                               : ResultCell());
  const StringFigures expected = ExpectedOf(*line, curve);
  for (const double value : {expected.isc_A, expected.voc_V, expected.imp_A, expected.vmp_V,
                             expected.imp_A * expected.vmp_V, expected.slope_ohm}) {
    cells.push_back(NumberCell(value));
  }
  return cells;
}

}  // namespace

double SlopeAtOpenCircuit(const std::vector<double>& voltage_V,
                          const std::vector<double>& current_A, double short_circuit_current_A) {
  constexpr double kMostCurrent = 0.7;
  constexpr std::size_t kFewestReadings = 5;
  constexpr double kMostMisfit = 0.002;  // root mean square, in parts of the voltage
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < voltage_V.size(); ++i) {
    const double part = current_A[i] / short_circuit_current_A;
    if (voltage_V[i] > 0 && part < kMostCurrent && part > -kMostCurrent) used.push_back(i);
  }
  if (used.size() < kFewestReadings) return kUnknown;
  const auto rows = static_cast<Eigen::Index>(used.size());
  Eigen::MatrixXd basis(rows, 3);
  Eigen::VectorXd voltage(rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const std::size_t i = used[static_cast<std::size_t>(k)];
    const double part = current_A[i] / short_circuit_current_A;
    basis.row(k) << 1, part, std::log1p(-part);
    voltage[k] = voltage_V[i];
  }
  const Eigen::VectorXd fitted = LeastSquares(basis, voltage);
  const Eigen::VectorXd off = voltage - Times(basis, fitted);
  const double misses = std::sqrt(off.squaredNorm() / static_cast<double>(rows));
  if (misses > kMostMisfit * voltage.maxCoeff()) return kUnknown;
  const double slope_ohm = (fitted[2] - fitted[1]) / short_circuit_current_A;
  return slope_ohm > 0 ? slope_ohm : kUnknown;
}

BatchTaskType WithPlan(BatchTaskType task, std::shared_ptr<const PlantPlan> plan) {
  const std::size_t own = task.columns.size();
  for (ResultColumn& column : PlanColumns(plan != nullptr))
    task.columns.push_back(std::move(column));
  task.options.push_back({"plan", plan ? plan->Digest() : "neighbours", ""});
  task.run = [run = task.run, plan = std::move(plan), own](
                 const BatchCurve& curve, std::uint64_t seed, const Observer& observer) {
    TaskResult result = run(curve, seed, observer);
    if (result.interrupted) return result;
    result.cells.resize(own);
    const IvCurve& readings = *curve.curve;
    const KeyPoints key = FindKeyPoints(readings.voltage_V, readings.current_A);
    result.cells.push_back(NumberCell(
        SlopeAtOpenCircuit(readings.voltage_V, readings.current_A, key.short_circuit_current_A)));
    if (plan == nullptr) return result;
    for (ResultCell& cell : PlanCells(plan->Find(curve.id), readings)) {
      result.cells.push_back(std::move(cell));
    }
    return result;
  };
  return task;
}

}  // namespace lyrefit
