#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/public.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/device.h"
#include "lyrefit/law/parameter.h"
#include "lyrefit/study/audit_options.h"
#include "lyrefit/study/read_audit_rows.h"

namespace LYREFIT_PUBLIC lyrefit {

// What becomes of a row's claim when its RMSE is computed again.
enum class AuditVerdict {
  kReproduces,         // the claim comes out of the printed digits
  kReproducesChanged,  // it does after the change named
  kBetter,             // it does not; the row is better than its claim
  kOtherDevice,        // it does not; the row describes another device
  kTooCoarse,          // the printed digits leave room for almost any claim
  kBelowProved,        // no parameters whatever give the claim: it is proved
  kBelowKnown,         // nothing that was found gives it; that nothing can is not proved
  kFails,              // nothing that was tried explains the claim
  kNoParameters,       // the row has none; there may be some that give the claim
};

template <>
struct EnumTable<AuditVerdict> {
  static constexpr EnumText<AuditVerdict> kRows[] = {
      {AuditVerdict::kReproduces, "reproduces"},
      {AuditVerdict::kReproducesChanged, "reproduces if changed"},
      {AuditVerdict::kBetter, "better than claimed"},
      {AuditVerdict::kOtherDevice, "another device"},
      {AuditVerdict::kTooCoarse, "too coarse to tell"},
      {AuditVerdict::kBelowProved, "below the proved optimum"},
      {AuditVerdict::kBelowKnown, "below the best known"},
      {AuditVerdict::kFails, "does not reproduce"},
      {AuditVerdict::kNoParameters, "no parameters"},
  };
};

// A parameter outside its published range by more than its printed digits leave open.
struct LeftBound {
  ParameterInfo info;
  double value = 0;  // as printed
  double lower = 0;
  double upper = 0;
};

// A row read in one way: which curve and conditions, which units.
struct AuditReading {
  std::vector<std::string> changes;  // against what the row says, in plain words; empty: none
  std::string curve;                 // name
  double temperature_C = kUnknown;
  int cells = 1;                                      // in series
  Objective objective = Objective::kMeasuredCurrent;  // of the claim
  bool newton_step =
      false;  // of one Newton step from the measured currents, not of the solved ones
  bool any_constants = true;                 // none were stated, so all sets were tried
  std::vector<ConstantSet> constants;        // sets under which the claim reproduces, nearest first
  ConstantSet shown = ConstantSet::kCodata;  // the set of the figures below
  // Ampere, ohm of the module, n per cell; empty where the row has none, and no figures then.
  std::vector<double> parameters;
  std::vector<double> half_units;  // of the last printed digit of each
  RmsePair rmse;
  double figure_A = kUnknown;  // what is held against the claim: one of these, or of the step
  // How far the claim may lie from this figure: half a unit of the claim's last digit, and for
  // every parameter what half a unit of its last digit does to the figure. Twice that where digits
  // are taken for cut off.
  double tolerance_A = kUnknown;
  std::vector<LeftBound> left_bounds;
};

// A changed reading that reproduces the claim.
struct AuditExplanation {
  AuditReading reading;
  // Where the temperature was changed: the range that reproduces the claim.
  double low_temperature_C = kUnknown;
  double high_temperature_C = kUnknown;
  int readings_tried = 0;  // of all changes that were looked at
  // How many of the readings tried would come as near to the claim by accident, judging by how many
  // lie in its wider neighbourhood. An explanation needs this to be small.
  double chance = kUnknown;
};

// The RMSE of a row as it depends on the temperature alone, from -20 to 120 C.
struct AuditTemperatures {
  std::vector<double> at_claim_C;  // where it equals the claim
  double best_C = kUnknown;        // where it is least
  double best_A = kUnknown;
};

// How low a claim can go on the curve as it is.
struct AuditLowest {
  Objective objective = Objective::kMeasuredCurrent;  // of the claim
  double rmse_A = kUnknown;                           // of the best fit, n from 1 to 2
  // Nothing lies below, whatever the parameters: proved for n in the range below. Unknown for a curve
  // that nothing can be proved about.
  double lower_bound_A = kUnknown;
  double reached_A = kUnknown;          // by parameters within that range
  double n_lower = kUnknown;            // per cell; the range of the bound, or of the best fit
  double n_upper = kUnknown;            // end of that range
  double other_objective_A = kUnknown;  // the best fit of the other objective
  double newton_step_A = kUnknown;      // the least of one Newton step from the measured currents
};

// What was found out about one row.
struct AuditFinding {
  AuditRow row;
  AuditReading stated;                          // the row taken at its word
  AuditVerdict verdict = AuditVerdict::kFails;  // of the row at its word, or of what explains it
  std::string sentence;                         // the verdict in plain words, with numbers
  std::vector<AuditExplanation> explanations;   // those with the fewest changes, nearest first
  std::string bounds_name;                      // empty: none are published for the curve

  // Of a row that does not reproduce:
  std::optional<AuditExplanation> nearest;  // near the claim, or on it perhaps by accident
  std::optional<AuditTemperatures> temperatures;
  double short_circuit_A = kUnknown;         // Isc of the curve as stated
  std::optional<AuditReading> other_device;  // the curve whose Isc the row has, read to fit best
  double optimum_A = kUnknown;               // best fit to the curve as stated, n from 1 to 2
  std::optional<AuditLowest> lowest;         // also where the row has no parameters
};

// What was found out about a table of published parameters.
struct AuditReport {
  std::string version;
  std::string path;                    // of the table
  AuditOptions options;                // what was asked for
  std::vector<AuditFinding> findings;  // in the order of the rows
  std::vector<Error> bad_rows;         // rows that could not be read or whose curve is missing
  std::string remark;                  // how the table was read, where it is no UTF-8
};

// Findings with this verdict.
int CountFindings(const AuditReport& report, AuditVerdict verdict);

}  // namespace lyrefit
