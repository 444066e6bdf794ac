#pragma once

#include <vector>

#include "lyrefit/estimate/refine/model.h"

namespace lyrefit {

// Dropping a diode from a fit and adding it again. A diode is dropped by a saturation current of 0,
// and its ideality is then active as well.

// Marks the parameters of every dropped diode as active.
void ActivateAbsent(const ModelShape& shape, const std::vector<double>& p,
                    std::vector<bool>* active);

// Calls ActivateAbsent and drops diodes that may vanish and add no visible current at the largest
// voltage. True if one was dropped.
bool RemoveFaded(const ModelShape& shape, std::vector<double>* p, std::vector<bool>* active);

// A diode that would lower the sum of squares.
struct DiodeToAdd {
  double cosine = 0;  // of its current with the negative residuals
  double size = 0;    // its saturation current if no other parameter changes
  double n = 0;
};

// Finds the ideality, in the range of that of parameter `saturation`, whose diode current has the
// largest cosine with the negative residuals at `point`. A cosine of 0: there is none. Scans the
// coarsened model `coarse` if it is not null.
DiodeToAdd FindDiodeToAdd(const FitModel& model, const FitModel* coarse, const FitPoint& point,
                          int saturation);

}  // namespace lyrefit
