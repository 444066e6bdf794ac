// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string_view>

#include "lyrefit/base/public.h"

// Names that options and keys of JSON had in version 0.1. The command and the Python module accept
// the options and their values, and the results of the Python module find the keys, in all of version 1.
namespace LYREFIT_PUBLIC lyrefit {

// A name that changed.
struct FormerName {
  std::string_view former;  // the name in version 0.1
  std::string_view name;    // the name now
};

// Options, as in flags without the leading "--".
inline constexpr FormerName kFormerOptions[] = {
    {"healthy", "reference"},
    {"healthy-level", "reference-level"},
    {"free-fits", "individual-fits"},
    {"no-free-fits", "no-individual-fits"},
};

// Keys of JSON. A key that has two new names has two entries; the object has one of them.
inline constexpr FormerName kFormerKeys[] = {
    {"forms", "variants"},
    {"basins", "local_optima"},
    {"best_bird_polished", "refined_best_candidate"},
    {"best_bird_polished_A", "refined_best_candidate_A"},
    {"contenders", "algorithms"},
    {"departure", "lack_of_fit"},
    {"without_odd", "without_outliers"},
    {"odd", "outlier"},
    {"odd", "outliers"},
    {"free_fits", "individual_fits"},
    {"free_rmse", "individual_rmse"},
    {"free_parameters", "individual_parameters"},
    {"median_free_solved_current_A", "median_individual_solved_current_A"},
};

// Values of options, as in tables of base/enum_text.h.
inline constexpr FormerName kFormerValues[] = {
    {"mlo+knees", "mlo+shape"},
};

// The option's name now; `option` itself if it was not renamed.
constexpr std::string_view CurrentOption(std::string_view option) {
  for (const FormerName& pair : kFormerOptions) {
    if (pair.former == option) return pair.name;
  }
  return option;
}

}  // namespace lyrefit
