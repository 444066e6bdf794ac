#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/search/search.h"

namespace lyrefit {

// What candidates make of the extended law, as a fit would have tried them. What is searched there on a
// grid stays where the selection found it.
struct LawSearch {
  RmseTable rmse;
  SearchOptions options;
  SearchSummary summary;
  std::vector<double> best;  // parameters of the law
};
LawSearch SearchLaw(const Selection& selection, std::uint64_t seed, const Observer& observer);

}  // namespace lyrefit
