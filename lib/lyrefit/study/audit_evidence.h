#pragma once

#include <optional>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

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

}  // namespace lyrefit
