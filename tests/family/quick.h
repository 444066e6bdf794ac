#pragma once

#include "lyrefit/family/fit_family.h"

namespace lyrefit {

// Options of a family fit without its slow results that the test does not use.
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
