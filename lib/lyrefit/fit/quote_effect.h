#pragma once

#include <cmath>
#include <utility>

#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Effects are fitted in numbers of their own; people read them in units. `factor` leads there.
inline void QuoteEffect(double factor, double searched, double refined, Estimate* e) {
  for (double* value : {&e->bounds.lower, &e->bounds.upper, &e->bounds.search_lower,
                        &e->bounds.search_upper, &e->low_95, &e->high_95}) {
    *value *= factor;
  }
  e->standard_error *= std::fabs(factor);
  if (factor < 0) {
    std::swap(e->bounds.lower, e->bounds.upper);
    std::swap(e->bounds.search_lower, e->bounds.search_upper);
    std::swap(e->low_95, e->high_95);
  }
  e->searched = searched;
  e->refined = refined;
}

}  // namespace lyrefit
