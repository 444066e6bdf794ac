// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"
#include "lyrefit/translate/translation_report.h"

// A translated curve as a document, as text, JSON, CSV and a picture. The conventions are those of
// report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// A translated curve: the verdict and the recommended result with its expanded uncertainties; left
// out of a short text are the field test, all procedures, the budget, and the conditions of the
// measurement.
Document TranslationDocument(const TranslationReport& report);
std::string TranslationText(const TranslationReport& report, Length length = Length::kWhole);
std::string BriefTranslation(const TranslationReport& report);

// Uncertainties are in the units of their values; expanded ones have k = 2. `points` holds the
// curves.
std::string TranslationJson(const TranslationReport& report);

// One row for each procedure: curve, procedure, recommended, the six key points, each followed by
// its expanded uncertainty (..._U), why_not.
std::string TranslationCsv(const TranslationReport& report);

// A translated curve: the readings and the result of each procedure, the recommended one as a thick
// line; maximum power points are marked.
Figure TranslationFigure(const TranslationReport& report);
Expected<void> PlotTranslation(const TranslationReport& report, const std::string& path,
                               PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
