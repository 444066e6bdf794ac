#pragma once

#include <optional>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

struct DiodeValues {
  double u = 0;  // 1/V
  double saturation_A = 0;
};

// The diodes of a model, one for each window with its u and Is there, that together are the mixture:
// several may share an atom, and those that may vanish need none. None if no such model is, or if an
// Is would be too small for a number.
std::optional<std::vector<DiodeValues>> AsDiodes(const Mixture& mixture,
                                                 const std::vector<Window>& windows);

}  // namespace lyrefit
