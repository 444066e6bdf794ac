// Experimental: may change in a minor version (data/stable).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/error.h"
#include "lyrefit/base/numbers.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/public.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/model/device.h"
#include "lyrefit/model/parameter.h"
#include "lyrefit/study/read_audit_rows.h"

namespace LYREFIT_PUBLIC lyrefit {

// How a table of published parameters is checked.
struct AuditOptions {
  // Folders that are searched for curves, after the folder of the rows and its parent.
  std::vector<std::string> curve_folders;
  // Constants k and q of rows that state none. Unset: all three sets are tried, and the matching
  // ones are reported.
  std::optional<ConstantSet> constants;
  Objective objective = Objective::kMeasuredCurrent;  // objective of the claimed RMSEs
};

inline constexpr OptionRow<AuditOptions> kAuditOptionTable[] = {
    {"curves", "DIR", "a folder to look for the devices' curves in; may be repeated",
     &AuditOptions::curve_folders},
    {"constants", "NAME", "values of k and q of rows that do not say",
     EnumOption<&AuditOptions::constants>(), OptionTrait::kNone, ": any"},
    {"objective", "NAME", "which RMSE the claims are of", EnumOption<&AuditOptions::objective>()},
};

// The result for one row after its RMSE is computed again.
enum class AuditVerdict {
  kReproduces,         // the printed digits give the claim
  kReproducesChanged,  // they give it after the reported change
  kBetter,             // they do not; the computed RMSE is lower than the claim
  kOtherDevice,        // they do not; the row describes another device
  kTooCoarse,          // the printed digits are compatible with almost any claim
  kBelowProved,        // proved: no parameters at all give the claim
  kBelowKnown,         // no known parameters give the claim; there is no proof that none do
  kFails,              // no reading that was tried explains the claim
  kNoParameters,       // the row has no parameters; the claim may be possible
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

// A parameter outside its published range by more than its printed digits allow.
struct LeftBound {
  ParameterInfo info;
  double value = 0;  // as printed
  double lower = 0;
  double upper = 0;
};

// One interpretation of a row: its curve, conditions and units.
struct AuditReading {
  std::vector<std::string> changes;  // changes to what the row states, as phrases; empty: none
  std::string curve;                 // name
  double temperature_C = kUnknown;
  int cells = 1;                                      // in series
  Objective objective = Objective::kMeasuredCurrent;  // objective of the claim
  bool newton_step =
      false;  // RMSE of one Newton step from the measured currents, not of the solved currents
  bool any_constants = true;                 // the row states no constants, so all sets were tried
  std::vector<ConstantSet> constants;        // sets under which the claim reproduces, nearest first
  ConstantSet shown = ConstantSet::kCodata;  // the set used for the figures below
  // Currents in ampere, resistances of the module in ohm, n per cell. Empty: the row states no
  // parameters, and the figures below are unknown.
  std::vector<double> parameters;
  std::vector<double> half_units;  // half a unit of the last printed digit of each parameter
  RmsePair rmse;
  // The RMSE compared with the claim: one of `rmse`, or of the Newton step.
  double figure_A = kUnknown;
  // Largest compatible distance between the claim and this figure. It is half a unit of the claim's
  // last digit plus, for every parameter, the effect of half a unit of its last digit. It is
  // doubled if digits are read as truncated.
  double tolerance_A = kUnknown;
  std::vector<LeftBound> left_bounds;
};

// A changed reading that reproduces the claim.
struct AuditExplanation {
  AuditReading reading;
  // Temperature range that reproduces the claim, if the temperature was changed.
  double low_temperature_C = kUnknown;
  double high_temperature_C = kUnknown;
  int readings_tried = 0;  // number of changed readings that were tried
  // Expected number of tried readings this near to the claim by accident. It is estimated from the
  // number of readings in a wider range around the claim. An explanation requires a small value.
  double chance = kUnknown;
};

// The RMSE of a row as a function of the temperature alone, from -20 to 120 C.
struct AuditTemperatures {
  std::vector<double> at_claim_C;  // temperatures at which it equals the claim
  double best_C = kUnknown;        // temperature of the least RMSE
  double best_A = kUnknown;
};

// How low a claim can go on the unchanged curve.
struct AuditLowest {
  Objective objective = Objective::kMeasuredCurrent;  // objective of the claim
  double rmse_A = kUnknown;                           // RMSE of the best fit, n from 1 to 2
  // Proved lower bound of the RMSE for n in the range below and any other parameters. NaN: no proof
  // is possible for this curve.
  double lower_bound_A = kUnknown;
  double reached_A = kUnknown;  // RMSE of the best known parameters within that range
  double n_lower = kUnknown;  // per cell; lower end of the n range of the bound, or of the best fit
  double n_upper = kUnknown;  // upper end of that range
  double other_objective_A = kUnknown;  // RMSE of the best fit of the other objective
  double newton_step_A = kUnknown;      // least RMSE of one Newton step from the measured currents
};

// The result of the audit of one row.
struct AuditFinding {
  AuditRow row;
  AuditReading stated;                          // the row as stated
  AuditVerdict verdict = AuditVerdict::kFails;  // of the row as stated, or of its explanation
  std::string sentence;                         // the verdict as a sentence with numbers
  // Explanations with the fewest changes, nearest first.
  std::vector<AuditExplanation> explanations;
  std::string bounds_name;  // empty: no published bounds exist for the curve

  // Of a row that does not reproduce:
  // A reading near the claim, or a match that may be accidental.
  std::optional<AuditExplanation> nearest;
  std::optional<AuditTemperatures> temperatures;
  double short_circuit_A = kUnknown;         // Isc of the stated curve
  std::optional<AuditReading> other_device;  // the curve with the row's Isc, read to fit best
  double optimum_A = kUnknown;        // RMSE of the best fit to the stated curve, n from 1 to 2
  std::optional<AuditLowest> lowest;  // also set for rows without parameters
};

// The result of the audit of a table of published parameters.
struct AuditReport {
  std::string version;
  std::string path;                    // of the table
  AuditOptions options;                // options of the audit
  std::vector<AuditFinding> findings;  // in the order of the rows
  std::vector<Error> bad_rows;         // rows that could not be read or whose curve is missing
  std::string remark;                  // encoding of the table, if it is not UTF-8
};

// Number of findings with this verdict.
int CountFindings(const AuditReport& report, AuditVerdict verdict);

// Checks published parameter rows against the curves they are said to fit. It computes whether the
// claimed RMSE follows from the printed digits, and otherwise which simple mistake explains it.

// Audits every row of the table at `path`; ReadAuditRows describes its format. A row names its
// device as ReadCurve names a curve. The curve is looked up beside the table, in the parent of the
// table's folder, and in `options.curve_folders`. Every folder there with a curve.csv is also a
// candidate for the device a row really describes. Errors: an unreadable table, a missing folder.
Expected<AuditReport> Audit(const std::string& path, const AuditOptions& options = {});

}  // namespace lyrefit
