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
  kFails,              // nothing that was tried explains the claim
};

template <>
struct EnumTable<AuditVerdict> {
  static constexpr EnumText<AuditVerdict> kRows[] = {
      {AuditVerdict::kReproduces, "reproduces"},
      {AuditVerdict::kReproducesChanged, "reproduces if changed"},
      {AuditVerdict::kBetter, "better than claimed"},
      {AuditVerdict::kOtherDevice, "another device"},
      {AuditVerdict::kTooCoarse, "too coarse to tell"},
      {AuditVerdict::kFails, "does not reproduce"},
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
  bool any_constants = true;                          // none were stated, so all sets were tried
  std::vector<ConstantSet> constants;        // sets under which the claim reproduces, nearest first
  ConstantSet shown = ConstantSet::kCodata;  // the set of the figures below
  std::vector<double> parameters;            // ampere, ohm of the module, n per cell
  std::vector<double> half_units;            // of the last printed digit of each
  RmsePair rmse;
  // How far the claim may lie from the RMSE of its objective: half a unit of the claim's last
  // digit, and for every parameter what half a unit of its last digit does to the RMSE.
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
};

// What was found out about a table of published parameters.
struct AuditReport {
  std::string version;
  std::string path;                    // of the table
  AuditOptions options;                // what was asked for
  std::vector<AuditFinding> findings;  // in the order of the rows
  std::vector<Error> bad_rows;         // rows that could not be read or whose curve is missing
};

// Findings with this verdict.
int CountFindings(const AuditReport& report, AuditVerdict verdict);

}  // namespace lyrefit
