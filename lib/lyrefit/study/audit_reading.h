#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/iv_curve.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/study/audit.h"

namespace lyrefit {

// A curve that published rows are checked against.
struct AuditCurve {
  IvCurve curve;
  std::string path;    // as given to ReadCurve
  std::string folder;  // folder that holds the curve's published bounds
  PointSet points;
  double short_circuit_A = 0;
};

// All curves that the rows of one table can refer to.
struct AuditShelf {
  std::vector<std::string> places;  // folders, in search order
  std::vector<AuditCurve> curves;
};

// Reads every folder with a curve.csv in the folder of `rows_path`, in its parent and in `folders`.
// Unreadable curves are left out. Errors: one of `folders` does not exist.
Expected<AuditShelf> OpenShelf(const std::string& rows_path,
                               const std::vector<std::string>& folders);

// Position of the curve that `device` names. The curve is read and added to the shelf on first use.
// Errors: no such curve in any of the places, or an unreadable curve.
Expected<int> FindCurve(const std::string& device, AuditShelf* shelf);

// One interpretation of a row: as stated, or with changes.
struct ReadingPlan {
  int curve = 0;  // position on the shelf
  Conditions conditions;
  Objective objective = Objective::kMeasuredCurrent;
  bool newton_step = false;  // the current is one Newton step, not solved; see audit_lowest.h
  bool cut_off = false;      // printed digits are truncated, not rounded
  std::optional<ConstantSet> constants;  // unset: any of the sets
  bool resistances_per_cell = false;     // Rs and Rsh are multiplied by the cells in series
  bool ideality_of_module = false;       // n is divided by the cells in series
  // The saturation currents of this diode, or of all diodes, are in `unit` instead of the column's
  // unit.
  static constexpr int kNoDiode = -1;
  static constexpr int kAllDiodes = -2;
  int diode = kNoDiode;
  double unit = 1;  // in ampere
  int changes = 0;  // number of changes to what the row states
};

// A row together with its curve.
struct AuditSubject {
  const AuditRow* row = nullptr;
  const AuditShelf* shelf = nullptr;
  ReadingPlan stated;
};

// `row` as stated, on curve `curve` of the shelf.
AuditSubject MakeSubject(const AuditRow& row, int curve, const AuditShelf& shelf,
                         const AuditOptions& options);

// All plans with at most `most_changes` changes, those with fewer first. The possible changes are
//   - another curve of the shelf at its own conditions, if its short-circuit current is about the
//     photocurrent of the row,
//   - resistances per cell,
//   - n of the module,
//   - saturation currents in another unit, of one diode or of all,
//   - another temperature (every whole degree from -20 to 120 C and a few round ones in kelvin),
//   - the other objective, or one Newton step instead of the solved current,
//   - constants other than stated,
//   - digits that are truncated instead of rounded; this one only alone.
std::vector<ReadingPlan> ReadingPlans(const AuditSubject& subject, int most_changes);

// The changes of a plan as phrases.
std::vector<std::string> ChangesOf(const AuditSubject& subject, const ReadingPlan& plan);

// RMSE and tolerance of one row under many plans. Not thread-safe.
class ReadingEvaluator {
 public:
  explicit ReadingEvaluator(const AuditSubject& subject);

  // Sets of constants that a plan allows.
  static std::vector<ConstantSet> SetsOf(const ReadingPlan& plan);
  // Parameter values under a plan: currents in ampere, resistances of the module in ohm, n per
  // cell.
  std::vector<double> Parameters(const ReadingPlan& plan) const;
  // Half a unit of the last printed digit of each parameter, in the units of Parameters().
  std::vector<double> HalfUnits(const ReadingPlan& plan) const;
  double Rmse(const ReadingPlan& plan, Objective objective, ConstantSet constants);
  // The RMSE that the plan compares with the claim: of its objective, or of one Newton step.
  double Figure(const ReadingPlan& plan, ConstantSet constants);
  // Tolerance of the plan's figure in ampere; AuditReading::tolerance_A defines it.
  double Tolerance(const ReadingPlan& plan, ConstantSet constants);
  // All results for a plan except the violated bounds.
  AuditReading Read(const ReadingPlan& plan);

 private:
  double RmseOf(const std::vector<double>& parameters, const ReadingPlan& plan, Objective objective,
                ConstantSet constants);
  double FigureOf(const std::vector<double>& parameters, const ReadingPlan& plan,
                  ConstantSet constants);

  const AuditSubject& subject_;
  Device device_;
};

}  // namespace lyrefit
