// Experimental: may change in a minor version (data/stable).
#pragma once

#include "lyrefit/base/option.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/base/public.h"

namespace LYREFIT_PUBLIC lyrefit {

// Significance level and resources of a comparison with reference sweeps.
struct ReferenceOptions {
  double level = 0.01;  // family-wise error rate over all quantities compared
  int threads = 0;      // 0: all cores; never changes a result
};

inline constexpr OptionRow<ReferenceOptions> kReferenceOptionTable[] = {
    OptionRow<ReferenceOptions>("Against its own history"),
    {"reference-level", "", "rate of false alarms of the comparison with reference sweeps",
     &ReferenceOptions::level, 1e-6, 0.5},
    {"threads", "N", "0: all cores; never changes a result", &ReferenceOptions::threads, 0,
     kMostThreads, OptionTrait::kQuiet | OptionTrait::kNoFlag | OptionTrait::kNoEcho},
};

}  // namespace lyrefit
