#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/fill_factor.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// Whether the lit readings reach past the knee, near enough to open circuit to determine n and Rs.
bool ReachesPastKnee(const Readings& readings);

// Leak, ideality and series resistance of the extended model under standard light, where the whole
// interval lies above what devices without a fault have and the loss of Pmax is material, the
// largest loss first. Empty if the model misses the readings by more than the floor of the current,
// or if the sweep ends before its knee. An ideality below that of any junction is added where the
// verdict names no cause.
std::vector<DeviceFinding> FindDeviceFindings(const Selection& selection, const DeviceKind& kind,
                                              const std::vector<Cause>& causes,
                                              const Floors& floors);

// Adds a fill factor below that of modules without a fault, first, unless a cause is named or another
// finding explains most of it.
void AddFillFactor(const std::optional<FillFactor>& fill_factor, const std::vector<Cause>& causes,
                   std::vector<DeviceFinding>* findings);

}  // namespace lyrefit
