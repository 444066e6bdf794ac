#pragma once

#include "lyrefit/family/fit_family.h"

namespace lyrefit {

// A family fit without what takes time and a test does not look at.
inline FamilyOptions Quick() {
  FamilyOptions options;
  options.search.population = 12;
  options.search.iterations = 15;
  options.random_baseline = false;
  options.individual_fits = false;
  options.folds = 0;
  options.threads = 2;
  return options;
}

}  // namespace lyrefit
