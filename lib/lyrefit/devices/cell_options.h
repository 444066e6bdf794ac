// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/constants.h"
#include "lyrefit/base/enum_text.h"
#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Options of the description of a laboratory cell.
struct CellOptions {
  ConstantSet constants = ConstantSet::kCodata;
  bool fit = true;           // fit the single-diode model to each sweep
  double largest_n = 6;      // upper bound of n of these fits, whose lower bound is 1
  double ideal_n = 2.2;      // an n above it is none of one junction
  double hysteresis = 0.5;   // least gap that counts as hysteresis, in percent of Isc
  double superposition = 1;  // least departure from superposition that counts, in percent of Isc
  int threads = 0;           // 0: all cores; never changes a result
};

inline constexpr OptionRow<CellOptions> kCellOptionTable[] = {
    OptionRow<CellOptions>("Cell"),
    {"fit", "", "key points and comparisons only, without fits of the single-diode model",
     &CellOptions::fit},
    {"largest-n", "N", "upper bound of n in the fits", &CellOptions::largest_n, 1.0, 20.0},
    {"ideal-n", "N", "an n above it is not called an ideality of the junction",
     &CellOptions::ideal_n, 1.0, 20.0},
    {"hysteresis", "PERCENT", "least gap between the directions that counts, of Isc",
     &CellOptions::hysteresis, 0.0, 100.0},
    {"superposition", "PERCENT", "least departure from superposition that counts, of Isc",
     &CellOptions::superposition, 0.0, 100.0},
    {"constants", "NAME", "values of k and q", EnumOption<&CellOptions::constants>()},
    {"threads", "N", "0: all cores; never changes a result", &CellOptions::threads, 0, kMostThreads,
     OptionTrait::kQuiet | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
