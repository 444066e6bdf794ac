#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/diagnose/diagnose_options.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/select.h"

namespace lyrefit {

// What is known of the device and its conditions beside the readings.
struct DeviceKind {
  std::string technology;        // as the curve states it; may be empty
  bool irradiance_known = true;  // false: a default is used
};

// Whether a fill factor is certainly below that of modules without a fault.
bool IsLow(const FillFactor& fill_factor);

// Adds the fill factor of a module of silicon in one sweep under known light, whose cells are counted,
// and what a Suns-Voc trace shows of its resistance. Judges the resistances among the
// causes by them.
void JudgeFillFactor(const Selection& selection, const DeviceKind& kind,
                     const DiagnoseOptions& options, Verdict* verdict);

// Where the fill factor is low and nothing is named, names the set of causes that draw curves alike,
// with their probabilities and the power that all of them cost. `findings`: parameters of the base
// model that are out of range, which are the base model's own member of the set. None if its
// ideality or series resistance explains most of it. With a trace no resistance is among them.
void NameFillFactor(const Selection& selection, const std::vector<DeviceFinding>& findings,
                    const std::vector<const Effect*>& candidates, const JudgeOptions& judge,
                    const DiagnoseOptions& options, Verdict* verdict);

// Fill factor that new modules of crystalline silicon lose to series resistance under 1000 W/m2: of
// eight modules of HIT, IBC, PERC and other cells, flashed with Suns-Voc beside, 0.055 to 0.074.
// It scales with the light.
inline constexpr double kUsualResistanceLoss = 0.065;
inline constexpr double kUsualResistanceScatter = 0.006;  // standard deviation
inline constexpr double kMostResistanceLoss = 0.074;
// From so much more of the fill factor on, a resistance is a finding.
inline constexpr double kNotedResistanceLoss = 0.03;

// Whether it exceeds that of new modules, by what is a finding, and certainly.
bool IsNoted(const ResistanceLoss& loss);

// Whether a cause is a series resistance.
bool IsResistance(const Cause& cause);

// Of a module of silicon with a Suns-Voc trace beside a sweep, and no sweep under another light or at
// another temperature (a dark one may be there): from the maximum powers of trace and
// sweep where the sweep has no rise, else from the voltages between them at small currents, which
// every cell still gives. None for others, and if the readings do not reach the knee.
std::optional<ResistanceLoss> FindResistanceLoss(const Selection& selection,
                                                 const std::string& technology);

// Judges the resistances among the causes by that loss: those within the loss of new modules are none,
// the others recover what is beyond it. What a trace shows beyond it is a cause even if the fit named
// none, beside what else was named, if that cause is `wanted`.
void JudgeResistance(const ResistanceLoss& loss, const Selection& selection, bool wanted,
                     Verdict* verdict);

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
