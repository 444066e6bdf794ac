#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/audit_curves.h"
#include "lyrefit/study/audit_report.h"

namespace lyrefit {

// One way to read a row: what the row says, or that with changes.
struct ReadingPlan {
  int curve = 0;  // on the shelf
  Conditions conditions;
  Objective objective = Objective::kMeasuredCurrent;
  bool newton_step = false;  // not the solved current: one step towards it, see audit_newton.h
  bool cut_off = false;      // printed digits are cut off there, not rounded
  std::optional<ConstantSet> constants;  // unset: any of the sets
  bool resistances_per_cell = false;     // Rs and Rsh times the cells in series
  bool ideality_of_module = false;       // n divided by them
  // The saturation currents of this diode, or of all, in another unit than the column's.
  static constexpr int kNoDiode = -1;
  static constexpr int kAllDiodes = -2;
  int diode = kNoDiode;
  double unit = 1;  // in ampere
  int changes = 0;  // against what the row says
};

// A row that has found its curve.
struct AuditSubject {
  const AuditRow* row = nullptr;
  const AuditShelf* shelf = nullptr;
  ReadingPlan stated;
};

// The row at its word, on that curve.
AuditSubject MakeSubject(const AuditRow& row, int curve, const AuditShelf& shelf,
                         const AuditOptions& options);

// All plans with at most `most_changes` changes, those with fewer first. The changes are another
// curve of the shelf at its own conditions, if its short-circuit current is about the photocurrent
// of the row; resistances per cell; n of the module; saturation currents in another unit, of one
// diode or of all; another temperature (every whole degree from -20 to 120 C and a few in kelvin);
// the other objective, or one Newton step in the place of the solved current; constants other than
// stated; and, alone, digits that are cut off instead of rounded.
std::vector<ReadingPlan> ReadingPlans(const AuditSubject& subject, int most_changes);

// The changes of a plan in plain words.
std::vector<std::string> ChangesOf(const AuditSubject& subject, const ReadingPlan& plan);

// RMSE and tolerance of one row under many plans. Not for several threads at once.
class ReadingEvaluator {
 public:
  explicit ReadingEvaluator(const AuditSubject& subject);

  // Sets of constants that a plan leaves open.
  static std::vector<ConstantSet> SetsOf(const ReadingPlan& plan);
  // Values under a plan in ampere, ohm of the module, and n per cell.
  std::vector<double> Parameters(const ReadingPlan& plan) const;
  // Half a unit of the last printed digit of each, in the same units.
  std::vector<double> HalfUnits(const ReadingPlan& plan) const;
  double Rmse(const ReadingPlan& plan, Objective objective, ConstantSet constants);
  // What the plan holds against the claim: the RMSE of its objective, or of one Newton step.
  double Figure(const ReadingPlan& plan, ConstantSet constants);
  // See AuditReading; of the plan's objective.
  double Tolerance(const ReadingPlan& plan, ConstantSet constants);
  // Everything there is to say about a plan but its bounds.
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
