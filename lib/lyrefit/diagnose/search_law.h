#pragma once

#include <cstdint>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/diagnose/select.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/search/search.h"

namespace lyrefit {

// Global search for the parameters of the extended law, with the fit's default optimizer.
// Parameters that are selected on a grid stay at the values of the selection.
struct LawSearch {
  RmseTable rmse;
  SearchOptions options;
  SearchSummary summary;
  std::vector<double> best;  // parameters of the law
};
LawSearch SearchLaw(const Selection& selection, std::uint64_t seed, const Observer& observer);

}  // namespace lyrefit
