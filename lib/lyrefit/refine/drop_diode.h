#pragma once

#include <vector>

#include "lyrefit/refine/model.h"

namespace lyrefit {

// What may vanish from a fit and come back: a diode, by its saturation current, which takes its
// ideality along.

// Holds what belongs to a diode that is not there.
void HoldAbsent(const ModelShape& shape, const std::vector<double>& p, std::vector<bool>* held);

// HoldAbsent, and takes out diodes that may vanish and no longer show at the largest voltage; true
// if there was one.
bool RemoveFaded(const ModelShape& shape, std::vector<double>* p, std::vector<bool>* held);

// A diode that would be of use where there is none.
struct DiodeToAdd {
  double cosine = 0;  // of its current with what the residuals ask for
  double size = 0;    // its saturation current if nothing else moved
  double n = 0;
};

// The ideality in the range of parameter `saturation`'s at which the residuals at `point` ask most
// for it; a cosine of 0: nowhere. Looked for on the few points that stand for many, if there are
// such (`coarse`, may be null).
DiodeToAdd FindDiodeToAdd(const FitModel& model, const FitModel* coarse, const FitPoint& point,
                      int saturation);

}  // namespace lyrefit
