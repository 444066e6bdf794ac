#include "lyrefit/study/audit_reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "lyrefit/base/number_text.h"
#include "lyrefit/curve/key_points.h"
#include "lyrefit/read/read_curve.h"
#include "lyrefit/read/table_curve.h"
#include "lyrefit/study/audit_lowest.h"

namespace lyrefit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostCurves = 200;  // limit for the curves read from all places

bool Exists(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

double ShortCircuitCurrent(const IvCurve& curve) {
  const double isc = FindKeyPoints(curve.voltage_V, curve.current_A).short_circuit_current_A;
  return std::isnan(isc) ? *std::max_element(curve.current_A.begin(), curve.current_A.end()) : isc;
}

AuditCurve Shelve(IvCurve curve, const fs::path& path) {
  AuditCurve shelved;
  shelved.points = MakePointSet(curve.voltage_V, curve.current_A);
  shelved.short_circuit_A = ShortCircuitCurrent(curve);
  shelved.path = path.lexically_normal().string();
  shelved.folder = (IsFolder(path) ? path : path.parent_path()).string();
  shelved.curve = std::move(curve);
  return shelved;
}

// Position of the curve on the shelf that was read from this file or folder.
std::optional<int> PositionOf(const fs::path& path, const AuditShelf& shelf) {
  for (std::size_t i = 0; i < shelf.curves.size(); ++i) {
    std::error_code error;
    if (fs::equivalent(path, shelf.curves[i].path, error)) return static_cast<int>(i);
  }
  return std::nullopt;
}

void ShelveFolder(const fs::path& place, AuditShelf* shelf) {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(place, error)) {
    if (Exists(entry.path() / "curve.csv")) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());  // the directory order depends on the file system
  for (const fs::path& folder : folders) {
    if (shelf->curves.size() >= kMostCurves) return;
    if (PositionOf(folder, *shelf)) continue;
    Expected<IvCurve> curve = ReadCurve(folder.string());
    if (curve) shelf->curves.push_back(Shelve(std::move(*curve), folder));
  }
}

}  // namespace

Expected<AuditShelf> OpenShelf(const std::string& rows_path,
                               const std::vector<std::string>& folders) {
  AuditShelf shelf;
  std::error_code error;
  fs::path rows_folder = fs::path(rows_path).parent_path();
  if (rows_folder.empty()) rows_folder = ".";
  shelf.places = {rows_folder.string(), (rows_folder / "..").lexically_normal().string()};
  for (const std::string& folder : folders) {
    if (!IsFolder(folder)) return Fail("expected a folder of curves", folder);
    shelf.places.push_back(folder);
  }
  for (const std::string& place : shelf.places) ShelveFolder(place, &shelf);
  return shelf;
}

Expected<int> FindCurve(const std::string& device, AuditShelf* shelf) {
  std::string tried;
  for (const std::string& place : shelf->places) {
    for (const char* ending : {"", ".csv", ".json"}) {
      const fs::path path = fs::path(place) / (device + ending);
      if (!Exists(path)) continue;
      if (const auto position = PositionOf(path, *shelf)) return *position;
      Expected<IvCurve> curve = ReadCurve(path.string());
      if (!curve) return tl::unexpected(curve.error());
      shelf->curves.push_back(Shelve(std::move(*curve), path));
      return static_cast<int>(shelf->curves.size()) - 1;
    }
    tried += (tried.empty() ? "" : ", ") + place;
  }
  return Fail(fmt::format("no curve of device {} in {}", Quoted(device), tried));
}

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
