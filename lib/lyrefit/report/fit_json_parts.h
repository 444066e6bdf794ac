#pragma once

#include <vector>

#include "lyrefit/fit/fit_report.h"
#include "lyrefit/report/json_parts.h"
#include "lyrefit/report/json_report.h"

// What the JSON writers of fits, of one curve and of many, share.
namespace lyrefit {

// What JsonReport writes.
Json FitJson(const FitReport& report, JsonPoints points);

// Everything about one parameter; without a polish nothing is refined.
Json EstimateJson(const Estimate& estimate, bool polished);

// The sizes of the errors of the readings; null where nobody looked for them.
Json ErrorsJson(const std::optional<ErrorReport>& errors);

// Both errors, each under its label.
Json RmsePairJson(const RmsePair& rmse);

Json KeyPointsJson(const KeyPoints& points);
Json CorrelationsJson(const std::vector<Correlation>& correlations);
Json LargestErrorJson(const ResidualStatistics& r);
Json ResidualsJson(const ResidualStatistics& r);  // all but the largest error
Json SearchJson(const SearchOptions& options, const SearchSummary& search,
                std::int64_t curve_evaluations);

}  // namespace lyrefit
