#pragma once

#include "../translate/synthetic_string.h"
#include "lyrefit/translate/translate.h"

namespace lyrefit {

// A simulated module of 60 cells, translated from 800 W/m2, 45 C to standard conditions, without a
// diagnosis.
inline TranslationReport SampleTranslation(int draws = 300) {
  const SyntheticModule module;
  TranslateOptions options;
  options.coefficients = module.Coefficients();
  options.procedures = {Procedure::kIec1, Procedure::kIec3, Procedure::kDeSoto};
  options.uncertainty.draws = draws;
  options.uncertainty.seed = 7;
  return *TranslateCurve(module.Measured(800, 45), options);
}

}  // namespace lyrefit
