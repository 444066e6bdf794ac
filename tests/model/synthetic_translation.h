#pragma once

#include <vector>

#include "lyrefit/model/translation.h"

namespace lyrefit {

inline TranslationSpec DeSoto60() {
  TranslationSpec spec;
  spec.cells_in_series = 60;
  return spec;
}

// Shared parameters of a silicon module by De Soto's law.
inline const std::vector<double> kSilicon = {9.1, 3e-10,  1.01,  0.29,
                                             380, 0.0046, 1.121, -0.0002677};

inline TranslationSpec Pvsyst106(ShuntLaw shunt, bool recombination) {
  TranslationSpec spec;
  spec.law = TranslationLaw::kPvsyst;
  spec.shunt = shunt;
  spec.recombination = recombination;
  spec.cells_in_series = 106;
  spec.constants = recombination ? ConstantSet::kLiterature : ConstantSet::kCodata;
  return spec;
}

}  // namespace lyrefit
