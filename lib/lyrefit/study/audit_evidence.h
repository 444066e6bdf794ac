#pragma once

#include <optional>
#include <vector>

#include "lyrefit/study/audit_reading.h"

namespace lyrefit {

// What else can be said about a row whose claim does not reproduce.

// How its RMSE as stated depends on the temperature.
AuditTemperatures ScanTemperatures(const AuditSubject& subject);

// Whether its photocurrent is more than 10 % off the short-circuit current of the curve as stated.
bool HasOtherPhotocurrent(const AuditSubject& subject);

// The curve whose short-circuit current agrees with its photocurrent to 2 %, read with the
// resistances, n and temperature that fit best. Empty: there is none, or the row does not follow
// it, with an RMSE above 5 % of the short-circuit current.
std::optional<AuditReading> FindOtherDevice(const AuditSubject& subject);

// Parameters outside the bounds by more than half a unit of their last digit.
std::vector<LeftBound> FindLeftBounds(const Device& device,
                                      const std::vector<ParameterBounds>& bounds,
                                      const AuditReading& reading);

}  // namespace lyrefit
