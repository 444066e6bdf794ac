#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// Proves how much of the base model's misfit single causes can explain at most, on the readings of
// the selection. Causes whose current is linear in their strength: measured-current objective, by
// certify/cause_floor.h. Unequal cells and a shaded part: solved-current objective, by the concave
// shape of their curves (certify/concave_floor.h). `diagnosis` must hold verdict, trials and gain.
// No proofs for dark curves, several conditions, readings with their own light or temperature, or
// more than 2000 readings.
Proofs FindProofs(const CurveSet& set, const Selection& selection, const AtReadings& at,
                  const Diagnosis& diagnosis, const ProgressReporter& progress);

}  // namespace lyrefit
