#include "lyrefit/study/audit_reading.h"

#include <algorithm>
#include <cmath>

#include "lyrefit/model/kernel.h"
#include "lyrefit/study/audit_newton.h"

namespace lyrefit {
namespace {

// Converts values from the unit of the column or of the printed text to the unit of the plan.
std::vector<double> Convert(const AuditRow& row, const ReadingPlan& plan,
                            double PrintedNumber::*member) {
  std::vector<double> values;
  for (const PrintedNumber& number : row.parameters) values.push_back(number.*member);
  if (values.empty()) return values;
  const int diodes = static_cast<int>(row.model);
  const double cells = plan.conditions.cells_in_series;
  if (plan.resistances_per_cell) {
    values[kRs] *= cells;
    values[kRsh] *= cells;
  }
  for (int d = 0; d < diodes; ++d) {
    if (plan.ideality_of_module) values[IdealityIndex(d)] /= cells;
    if (plan.diode == d || plan.diode == ReadingPlan::kAllDiodes) {
      const int i = SaturationCurrentIndex(d);
      values[i] *= plan.unit / row.parameters[i].factor;
    }
  }
  return values;
}

}  // namespace

AuditSubject MakeSubject(const AuditRow& row, int curve, const AuditShelf& shelf,
                         const AuditOptions& options) {
  AuditSubject subject;
  subject.row = &row;
  subject.shelf = &shelf;
  ReadingPlan& stated = subject.stated;
  stated.curve = curve;
  stated.conditions = shelf.curves[curve].curve.conditions;
  if (row.temperature_C) stated.conditions.cell_temperature_K = *row.temperature_C + kZeroCelsius_K;
  if (row.cells) stated.conditions.cells_in_series = *row.cells;
  stated.objective = row.objective.value_or(options.objective);
  stated.constants = row.constants ? row.constants : options.constants;
  return subject;
}

ReadingEvaluator::ReadingEvaluator(const AuditSubject& subject)
    : subject_(subject), device_(MakeDevice(subject.row->model, subject.stated.conditions)) {}

std::vector<ConstantSet> ReadingEvaluator::SetsOf(const ReadingPlan& plan) {
  if (plan.constants) return {*plan.constants};
  std::vector<ConstantSet> sets;
  for (const auto& row : EnumTable<ConstantSet>::kRows) sets.push_back(row.value);
  return sets;
}

std::vector<double> ReadingEvaluator::Parameters(const ReadingPlan& plan) const {
  return Convert(*subject_.row, plan, &PrintedNumber::value);
}

std::vector<double> ReadingEvaluator::HalfUnits(const ReadingPlan& plan) const {
  return Convert(*subject_.row, plan, &PrintedNumber::half_unit);
}

double ReadingEvaluator::RmseOf(const std::vector<double>& parameters, const ReadingPlan& plan,
                                Objective objective, ConstantSet constants) {
  device_.module_thermal_voltage_V = plan.conditions.ModuleThermalVoltage(constants);
  const PointSet& points = subject_.shelf->curves[plan.curve].points;
  return std::sqrt(MeanSquare(device_, objective, parameters.data(), points));
}

double ReadingEvaluator::Rmse(const ReadingPlan& plan, Objective objective, ConstantSet constants) {
  return RmseOf(Parameters(plan), plan, objective, constants);
}

double ReadingEvaluator::FigureOf(const std::vector<double>& parameters, const ReadingPlan& plan,
                                  ConstantSet constants) {
  if (!plan.newton_step) return RmseOf(parameters, plan, plan.objective, constants);
  device_.module_thermal_voltage_V = plan.conditions.ModuleThermalVoltage(constants);
  return NewtonStepRmse(device_, parameters, subject_.shelf->curves[plan.curve].curve);
}

double ReadingEvaluator::Figure(const ReadingPlan& plan, ConstantSet constants) {
  return FigureOf(Parameters(plan), plan, constants);
}

double ReadingEvaluator::Tolerance(const ReadingPlan& plan, ConstantSet constants) {
  std::vector<double> parameters = Parameters(plan);
  const std::vector<double> half_units = HalfUnits(plan);
  const double centre = FigureOf(parameters, plan, constants);
  // Number of half units: truncated digits have twice the error.
  const double part = plan.cut_off ? 2 : 1;
  double tolerance = part * subject_.row->rmse.half_unit;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (half_units[i] == 0) continue;
    const double value = parameters[i];
    double largest = 0;
    for (const double step : {-part * half_units[i], part * half_units[i]}) {
      parameters[i] = std::max(value + step, 0.0);
      const double moved = FigureOf(parameters, plan, constants);
      largest = std::max(largest, std::fabs(moved - centre));
    }
    parameters[i] = value;
    tolerance += largest;
  }
  return tolerance;
}

AuditReading ReadingEvaluator::Read(const ReadingPlan& plan) {
  const double claim = subject_.row->rmse.value;
  AuditReading reading;
  reading.changes = ChangesOf(subject_, plan);
  reading.curve = subject_.shelf->curves[plan.curve].curve.name;
  reading.temperature_C = plan.conditions.cell_temperature_K - kZeroCelsius_K;
  reading.cells = plan.conditions.cells_in_series;
  reading.objective = plan.objective;
  reading.newton_step = plan.newton_step;
  reading.parameters = Parameters(plan);
  reading.half_units = HalfUnits(plan);
  const std::vector<ConstantSet> sets = SetsOf(plan);
  reading.any_constants = !plan.constants;
  reading.shown = sets.front();
  if (reading.parameters.empty()) return reading;
  const auto miss = [&](ConstantSet set) { return std::fabs(Figure(plan, set) - claim); };
  for (const ConstantSet set : sets) {
    if (miss(set) <= Tolerance(plan, set)) reading.constants.push_back(set);
  }
  std::stable_sort(reading.constants.begin(), reading.constants.end(),
                   [&](ConstantSet a, ConstantSet b) { return miss(a) < miss(b); });
  if (!reading.constants.empty()) reading.shown = reading.constants.front();
  reading.tolerance_A = Tolerance(plan, reading.shown);
  reading.rmse = {Rmse(plan, Objective::kMeasuredCurrent, reading.shown),
                  Rmse(plan, Objective::kSolvedCurrent, reading.shown)};
  reading.figure_A = Figure(plan, reading.shown);
  return reading;
}

}  // namespace lyrefit
