#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/study/audit.h"
#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

struct AuditSearch {
  std::vector<AuditExplanation> explanations;  // all with the fewest changes, nearest first
  std::optional<AuditExplanation> nearest;     // if there are no explanations; see AuditFinding
};

// Searches for the fewest changes, at most three, under which a row's claim reproduces.
//
// Thousands of readings are tried, so some match any claim by accident. The expected number of
// accidental matches is estimated from the readings themselves. Let N of the readings tried so far
// lie within a factor of exp(1/2) of the claim. Then N x 2 x tolerance / claim of them are expected
// within the tolerance. The number is added once more for every other open set of constants that
// gives another RMSE. A match with an expectation above 0.01 is not an explanation.
AuditSearch Explain(const AuditSubject& subject);

// Further evidence about a row whose claim does not reproduce.

// RMSE of the row as stated, as a function of the temperature.
AuditTemperatures ScanTemperatures(const AuditSubject& subject);

// True if the row's photocurrent is more than 10 % off the short-circuit current of the stated
// curve.
bool HasOtherPhotocurrent(const AuditSubject& subject);

// The curve whose short-circuit current agrees with the row's photocurrent to 2 %. Resistances, n
// and temperature are read in the way that fits that curve best. Empty: no such curve, or an RMSE
// above 5 % of its short-circuit current.
std::optional<AuditReading> FindOtherDevice(const AuditSubject& subject);

// Parameters outside their bounds by more than half a unit of their last printed digit.
std::vector<LeftBound> FindLeftBounds(const Device& device,
                                      const std::vector<ParameterBounds>& bounds,
                                      const AuditReading& reading);

// The verdict of a finding as a sentence with numbers.
std::string AuditSentence(const AuditFinding& finding);

// The changes of a reading as text: "with Rs and Rsh per cell (x 36) and at 75 C in place of 25 C".
std::string JoinedChanges(const AuditReading& reading);

// "Rs 0.00801 below 0.2, n1 2.3 above 2"; empty if no bound is violated.
std::string LeftBoundsText(const std::vector<LeftBound>& left);

}  // namespace lyrefit
