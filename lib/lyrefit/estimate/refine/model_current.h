#pragma once

#include <vector>

#include "lyrefit/model/device.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/law.h"

namespace lyrefit {

// Memory of this thread for blocks. The next call reuses it.
Block* ScratchBlocks(std::size_t size);

// The numbers of consecutive blocks, one after the other.
inline const double* NumbersOf(const Block* blocks) {
  return reinterpret_cast<const double*>(blocks);
}

// Model currents of an objective at every point: the explicit right-hand side at the measured
// current, or the solved current. `slopes`, if not null: derivatives by the device's parameters,
// row by row. Those of the solved current are those of the right-hand side at the root divided by 1
// - Rs F' (implicit function theorem). Differentiating the Newton iteration would cost more and be
// less exact. NaN if an equation with effects cannot be evaluated. Such an equation skips the
// derivatives by `fixed` parameters (1), which are then 0, and may reuse a workspace.
void ModelCurrents(const Device& device, Objective objective, const double* p,
                   const PointSet& points, const Kernel& kernel, double* current, double* slopes,
                   const std::vector<char>* fixed = nullptr, LawWorkspace* kept = nullptr);

}  // namespace lyrefit
