#pragma once

#include "lyrefit/trend/blocks.h"
#include "lyrefit/trend/trend_options.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// Fills the quantities of a report: the regressions of light, parameters, mismatch and power on
// time, with their changes. Needs the losses of every row (SplitLosses).
void FindQuantities(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report);

// Fills the losses and their days. Needs the quantities.
void FindLosses(const TrendBlocks& blocks, const TrendOptions& options, TrendReport* report);

// Fills the onsets: changes to the worse of a parameter or of mismatch, with what they may be.
void FindOnsets(const TrendBlocks& blocks, TrendReport* report);

}  // namespace lyrefit
