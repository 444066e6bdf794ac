#pragma once

#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Fills the quantities of a report that are parameters: their regressions on time, with their
// changes. In a series of most of a year the regression also has what the law leaves of light and
// temperature between days, which departures and levels then contain.
void FindParameters(const TrendOptions& options, TrendBlocks* blocks, TrendReport* report);

// Fills the quantities that are losses: mismatch and power. Needs the losses of every row
// (SplitLosses).
void FindPowers(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report);

// Fills the losses and their days. Needs the quantities.
void FindLosses(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report);

// Fills the onsets: changes to the worse of a parameter or of mismatch, with what they may be.
void FindOnsets(const TrendBlocks& blocks, TrendReport* report);

}  // namespace lyrefit
