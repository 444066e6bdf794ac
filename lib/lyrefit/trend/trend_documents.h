// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/trend/trend_report.h"

// A trend as a document, as text, JSON, CSV and a picture. The conventions are those of
// report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// What changed in a device over time: losses by part, steps and onsets, rates. The brief text is the
// verdict.
Document TrendDocument(const TrendReport& report);
std::string TrendText(const TrendReport& report);
std::string BriefTrend(const TrendReport& report);

// Quantities with their days, the loss by part, onsets.
std::string TrendJson(const TrendReport& report);

// One row for each day of a trend: its quantities at standard conditions, then the parts of the loss
// in percent of the expected energy.
std::string TrendCsv(const TrendReport& report);

// A trend: the daily losses by part, then every quantity with its regression and the days of its
// changes.
Figure TrendFigure(const TrendReport& report);
Expected<void> PlotTrend(const TrendReport& report, const std::string& path,
                         PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
