#pragma once

#include "lyrefit/diagnose/diagnosis.h"

namespace lyrefit {

// The cause that a row names: the most certain of the verdict, else the parameter of the device that
// is most out of range (DeviceFinding), with id, title, group and sentence. Its group is then that of
// AboutOf: "device", or "conditions" for an ideality below that of any junction. An empty id: neither.
Cause RowCause(const Diagnosis& diagnosis);

}  // namespace lyrefit
