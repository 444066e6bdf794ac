#pragma once

#include <utility>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/report/document.h"
#include "lyrefit/translate/checklist.h"
#include "lyrefit/translate/field_test.h"
#include "lyrefit/translate/uncertainty.h"

// What the documents, tables and pictures of one kind of record share.
namespace lyrefit {

struct Certificate;
struct CurveSet;
struct DataSheetFit;
struct MemberConditions;
struct TranslationReport;

// fits_document.cc: the parameters of the largest model: those of a smaller one are its first.
std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits);

// The answer of a fit and its standard error for the parameter with this symbol.
std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info);

// Whether the curves were fitted one by one, without shared parameters.
inline bool OneByOne(const FamilyReport& report) { return report.estimates.empty(); }

// "De Soto", as people write it.
inline const char* LawTitle(TranslationLaw law) {
  return law == TranslationLaw::kDeSoto ? "De Soto" : "PVsyst";
}

// Of a curve fitted on its own, in the order of FamilyCurve::free_parameters.
inline std::vector<ParameterInfo> FreeInfos(const FamilyReport& report) {
  std::vector<ParameterInfo> infos = MakeDevice(report.translation.spec.model, {}).parameters;
  if (report.free) AddInfos(report.with, &infos);
  return infos;
}

// record_verdicts.cc: what a report comes to, in a sentence or two.
std::string ResidualVerdict(const ResidualStatistics& residuals);
std::string FitVerdict(const FitReport& report);
std::string FamilyVerdict(const FamilyReport& report);

// figure_blocks.cc: the picture of a record for pages, with a sentence and what it shows in
// numbers. A figure without panels where there is nothing to draw.
block::Figure FigureBlock(const FitReport& report);
block::Figure FigureBlock(const Diagnosis& diagnosis);
block::Figure FigureBlock(const Certificate& certificate);
block::Figure FigureBlock(const FamilyReport& report, const CurveSet& set);

// data_sheet_plot.cc: likewise. data_sheet_document.cc: some members, by rising n.
block::Figure FigureBlock(const DataSheetFit& fit);
block::Table MemberTable(const DataSheetFit& fit);
// "200 W/m2", "50 C": what is not at the reference.
std::string ConditionsText(const MemberConditions& at);

// family_curve_document.cc: curve by curve, whole curves as a test, and those that were left out.
std::vector<Section> FamilyCurveSections(const FamilyReport& report);

// diagnosis_document.cc: each cause with its size and what else it could be.
std::vector<Section> CauseSections(const Diagnosis& diagnosis);

// diagnosis_proof_document.cc: how much of the misfit causes can explain, where that was asked for.
Section ProofSection(const Diagnosis& diagnosis);

// diagnosis_plot.cc: bands where causes act and their titles, in a panel over voltage whose ends are
// known.
void MarkCauses(const Diagnosis& diagnosis, Panel* panel);

// diagnosis_evidence_document.cc: how far a diagnosis is to be trusted.
std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis);

// field_test_document.cc: what the uncertainty of one result is made of, and whether both
// propagations agree; the verdict on a rating with its figures and its own budget; the conditions,
// each met, not met or not known, and what would make it known.
Section BudgetSection(const std::string& heading, const UncertaintyBudget& budget,
                      std::size_t output);
std::vector<Section> FieldTestSections(const FieldTest& test);
Section ChecklistSection(const Checklist& checklist);

// translation_page.cc: what a page begins with that somebody signs. Under what the curve was taken
// and by what, each with its source; the verdict in a line or a few; the picture with its numbers.
void AddMeasurement(const TranslationReport& report, Section* section);
std::string TranslationVerdict(const TranslationReport& report);
block::Figure FigureBlock(const TranslationReport& report);

}  // namespace lyrefit
