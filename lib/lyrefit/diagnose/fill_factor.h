#pragma once

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
// and what a Suns-Voc trace shows of its resistance (resistance.h). Judges the resistances among the
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

}  // namespace lyrefit
