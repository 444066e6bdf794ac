#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lyrefit/report/document.h"
#include "lyrefit/translate/checklist.h"
#include "lyrefit/translate/field_test.h"
#include "lyrefit/translate/translation_report.h"
#include "lyrefit/translate/uncertainty.h"

// Functions shared by the documents and pictures of a translated curve.
namespace lyrefit {

// field_test_document.cc: the budget of one result, and whether both propagations agree; the
// verdict on a rating with its own budget; the state of each condition of the measurement, and how
// to determine or meet it.
Section BudgetSection(const std::string& heading, const UncertaintyBudget& budget,
                      std::size_t output);
std::vector<Section> FieldTestSections(const FieldTest& test);
Section ChecklistSection(const Checklist& checklist);

// translation_page.cc: the first part of a page to be signed: conditions and instruments of the
// measurement, each with its source; the verdict in one line or a few; the picture with its
// numbers.
void AddMeasurement(const TranslationReport& report, Section* section);
std::string TranslationVerdict(const TranslationReport& report);
block::Figure FigureBlock(const TranslationReport& report);

}  // namespace lyrefit
