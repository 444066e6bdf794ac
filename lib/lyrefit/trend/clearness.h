#pragma once

#include <vector>

#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// The sky of each row: `clearness` is its light over that of a clear sky at its hour and season,
// `height` that of the clear sky over its largest of the day, both from 0 to 1. The clear sky is the
// 0.93 quantile of the light, a polynomial of the hour with coefficients that follow the season:
// neither place nor orientation needs to be known (Koenker and Bassett 1978, doi:10.2307/1913643, by
// iterated weights). Both stay 1 where the rows are too few to tell. `rows`: by time.
void FindSky(std::vector<TrendRow>* rows);

}  // namespace lyrefit
