#pragma once

#include "lyrefit/report/document.h"
#include "lyrefit/trend/trend_report.h"

namespace lyrefit {

// The picture of a trend for pages, with a caption and a table of its numbers.
block::Figure FigureBlock(const TrendReport& report);

}  // namespace lyrefit
