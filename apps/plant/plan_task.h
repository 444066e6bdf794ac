// Experimental: may change in a minor version (data/stable).
#pragma once

#include <memory>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/batch/batch_task.h"
#include "lyrefit/curve/iv_curve.h"
#include "plant/string_plan.h"

namespace LYREFIT_PUBLIC lyrefit {

// Adds to a task what the comparison with the plan needs: the slope of the curve at open circuit,
// and the key points that the plan expects at the stated light and temperature (plan_Isc_A, ...).
// The results then get the columns plan_cause, plan_sentence, ..., which name a fault that changes
// the scale of a string and not the shape of its curve (scale_judge.h). Any task whose rows are
// single curves can carry them. `plan` may be null: strings are then compared with those of their
// combiner alone. A row whose `cause` belongs to the device is not judged, since its scale is that
// of the cause.
BatchTaskType WithPlan(BatchTaskType task, std::shared_ptr<const PlantPlan> plan);

// Slope -dV/dI at open circuit in ohm: Rs + a / Iph of one diode, from the least squares V = c - Rs
// I + a ln(1 - I / Isc) over the readings below 0.7 Isc. Unknown for fewer than five of them,
// without an Isc, or where the diode misses them by 0.2 % of the voltage, as at a step of the curve.
double SlopeAtOpenCircuit(const std::vector<double>& voltage_V,
                          const std::vector<double>& current_A, double short_circuit_current_A);

}  // namespace lyrefit
