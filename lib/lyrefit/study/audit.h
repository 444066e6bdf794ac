#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/option.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/law/device.h"
#include "lyrefit/study/read_audit_rows.h"

namespace lyrefit {

// Checks published parameter rows against the curves they are said to fit: does the claimed RMSE
// come out of the printed digits, and if not, which plain mistake brings it back?

struct AuditOptions {
  // Folders to look for curves in, after the folder of the rows and its parent.
  std::vector<std::string> curve_folders;
  // Of rows that do not say. Unset: all three sets are tried, and those that fit are named.
  std::optional<ConstantSet> constants;
  Objective objective = Objective::kMeasuredCurrent;  // what the claims are of
};

inline constexpr OptionRow<AuditOptions> kAuditOptionTable[] = {
    {"curves", "DIR", "a folder to look for the devices' curves in; may be repeated",
     &AuditOptions::curve_folders},
    {"constants", "NAME", "values of k and q of rows that do not say",
     EnumOption<&AuditOptions::constants>(), OptionTrait::kNone, ": any"},
    {"objective", "NAME", "which RMSE the claims are of", EnumOption<&AuditOptions::objective>()},
};

enum class AuditVerdict {
  kReproduces,         // the claim comes out of the printed digits
  kReproducesChanged,  // it does after the change named
  kBetter,             // it does not; the row is better than its claim
  kOtherDevice,        // it does not; the row describes another device
  kTooCoarse,          // the printed digits leave room for almost any claim
  kFails,
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
  double value = 0;
  double lower = 0;
  double upper = 0;
};

// A row read in one way: which curve and conditions, which units.
struct AuditReading {
  std::vector<std::string> changes;  // against what the row says, in plain words; empty: none
  std::string curve;                 // name
  double temperature_C = kUnknown;
  int cells = 1;
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
  int readings_tried = 0;
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

struct AuditFinding {
  AuditRow row;
  AuditReading stated;  // the row taken at its word
  AuditVerdict verdict = AuditVerdict::kFails;
  std::string sentence;                        // the verdict in plain words, with numbers
  std::vector<AuditExplanation> explanations;  // those with the fewest changes, nearest first
  std::string bounds_name;                     // empty: none are published for the curve

  // Of a row that does not reproduce:
  std::optional<AuditExplanation> nearest;  // near the claim, or on it perhaps by accident
  std::optional<AuditTemperatures> temperatures;
  double short_circuit_A = kUnknown;         // Isc of the curve as stated
  std::optional<AuditReading> other_device;  // the curve whose Isc the row has, read to fit best
  double optimum_A = kUnknown;               // best fit to the curve as stated, n from 1 to 2
};

struct AuditReport {
  std::string version;
  std::string path;
  AuditOptions options;
  std::vector<AuditFinding> findings;  // in the order of the rows
  std::vector<Error> bad_rows;         // rows that could not be read or whose curve is missing
};

// Audits every row of the table at `path`, see ReadAuditRows. A row's device is a curve as
// ReadCurve takes it, looked up beside the table, in the parent of its folder, and in
// `options.curve_folders`; every folder there that holds a curve.csv may turn out to be the device
// a row really belongs to. Errors: the table as a whole, a folder that is not there.
Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options = {});

// Findings with this verdict.
int CountFindings(const AuditReport& report, AuditVerdict verdict);

}  // namespace lyrefit
