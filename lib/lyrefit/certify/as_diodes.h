#pragma once

#include <optional>
#include <vector>

#include "lyrefit/certify/mixture.h"

namespace lyrefit {

struct DiodeValues {
  double u = 0;  // 1 / (n Ns Vt), in 1/V
  double saturation_A = 0;
};

// Returns the diodes of a model that equals the mixture: one per window, in the order of `windows`,
// with u and Is inside that window. Several diodes may share one atom of the mixture. A diode whose
// Is may be 0 may have no atom; it then carries no current. Returns none if no such model exists,
// or if an Is is below 1e-305 A.
std::optional<std::vector<DiodeValues>> AsDiodes(const Mixture& mixture,
                                                 const std::vector<Window>& windows);

}  // namespace lyrefit
