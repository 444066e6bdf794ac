#pragma once

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/diagnose/average.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/watch.h"

namespace lyrefit {

// How much of the base model's misfit single causes can explain at most, on the readings that the
// selection fitted. Measured-current of causes whose current is linear in their strength, by
// certify/cause_floor.h; solved-current of unequal cells and of a shaded part, by the shape that
// their curves have (certify/concave_floor.h). The verdict, its trials and the gain stand in
// `diagnosis` already. None of a dark curve, of several conditions, of readings that have a light or
// a temperature each, and of thousands of them.
Proofs FindProofs(const CurveSet& set, const Selection& selection, const AtReadings& at,
                  const Diagnosis& diagnosis, Watch* watch);

}  // namespace lyrefit
