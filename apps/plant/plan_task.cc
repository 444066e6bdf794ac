#include "plant/plan_task.h"

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/append.h"
#include "lyrefit/base/constants.h"
#include "lyrefit/base/dense.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/batch/column.h"
#include "lyrefit/curve/key_points.h"
#include "plant/scale.h"

namespace lyrefit {
namespace {

// The figures that the plan expects of a string; unknown without a module or conditions.
StringFigures ExpectedOf(const PlannedString& line, const IvCurve& curve) {
  const bool known = line.module && curve.irradiance_known && curve.temperature_known &&
                     curve.conditions.irradiance_W_m2 > 0;
  if (!known) return {};
  return FiguresByPlan(line, curve.conditions.irradiance_W_m2, curve.conditions.cell_temperature_K);
}

struct PlanRow {
  PlanRow(const PlannedString* of, const IvCurve& curve)
      : line(of), expected(of == nullptr ? StringFigures() : ExpectedOf(*of, curve)) {
    const KeyPoints key = FindKeyPoints(curve.voltage_V, curve.current_A);
    slope_ohm = SlopeAtOpenCircuit(curve.voltage_V, curve.current_A, key.short_circuit_current_A);
  }

  const PlannedModule* Module() const { return line == nullptr ? nullptr : line->module.get(); }
  std::optional<int> Count(int PlannedString::*count) const {
    return line == nullptr ? std::nullopt : std::optional(line->*count);
  }

  const PlannedString* line;  // null: the plan does not name the string
  StringFigures expected;
  double slope_ohm = kUnknown;
};

ColumnList<PlanRow> PlanColumns(bool planned) {
  using Of = const PlanRow&;
  ColumnList<PlanRow> columns = {
      {kSlopeColumn, "ohm", "measured slope -dV/dI at open circuit", &PlanRow::slope_ohm}};
  if (!planned) return columns;
  Append({{"plan_module", "", "module of the string by the plan",
           [](Of of) { return of.Module() == nullptr ? "" : of.Module()->name; }},
          {"plan_modules_in_series", "", "modules in series by the plan",
           [](Of of) { return of.Count(&PlannedString::modules_in_series); }},
          {"plan_strings_in_parallel", "", "strings in parallel by the plan",
           [](Of of) { return of.Count(&PlannedString::strings_in_parallel); }},
          {"plan_bypass_diodes", "", "bypass diodes of a module by the plan",
           [](Of of) { return of.Count(&PlannedString::bypass_diodes); }},
          {"plan_cells_in_series", "", "cells in series of the string by the plan",
           [](Of of) {
             return of.Module() == nullptr
                        ? std::nullopt
                        : std::optional(std::int64_t{of.line->modules_in_series} *
                                        of.Module()->cells_in_series);
           }},
          {"plan_Isc_A", "A",
           "short-circuit current that the plan expects at the stated light and temperature",
           [](Of of) { return of.expected.isc_A; }},
          {"plan_Voc_V", "V", "open-circuit voltage that the plan expects",
           [](Of of) { return of.expected.voc_V; }},
          {"plan_Imp_A", "A", "current at maximum power that the plan expects",
           [](Of of) { return of.expected.imp_A; }},
          {"plan_Vmp_V", "V", "voltage at maximum power that the plan expects",
           [](Of of) { return of.expected.vmp_V; }},
          {"plan_Pmax_W", "W", "maximum power that the plan expects",
           [](Of of) { return of.expected.imp_A * of.expected.vmp_V; }},
          {"plan_slope_ohm", "ohm",
           "slope -dV/dI at open circuit that the plan expects, without cables",
           [](Of of) { return of.expected.slope_ohm; }}},
         &columns);
  return columns;
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
  const ColumnList<PlanRow> columns = PlanColumns(plan != nullptr);
  Append(HeadsOf(columns), &task.columns);
  task.options.push_back({"plan", plan ? plan->Digest() : "neighbours", ""});
  task.run = [run = task.run, plan = std::move(plan), own, columns](
                 const BatchCurve& curve, std::uint64_t seed, const Observer& observer) {
    TaskResult result = run(curve, seed, observer);
    if (result.interrupted) return result;
    result.cells.resize(own);
    const PlannedString* const line = plan == nullptr ? nullptr : plan->Find(curve.id);
    Append(CellsOf(columns, PlanRow(line, *curve.curve)), &result.cells);
    return result;
  };
  return task;
}

}  // namespace lyrefit
