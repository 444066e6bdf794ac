#pragma once

#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "plant/sample_summary.h"

namespace lyrefit {

// The section on samples of the summary: statistics by direction, yield, pixels that do not work.
// `criterion`: PixelCriterion() of the run. Samples beyond 40 are in samples.csv only.
std::vector<Section> SampleSections(const std::vector<SampleSummary>& samples,
                                    const std::string& criterion);

}  // namespace lyrefit
