#pragma once

#include <utility>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/report/document.h"
#include "lyrefit/translate/checklist.h"
#include "lyrefit/translate/field_test.h"
#include "lyrefit/translate/uncertainty.h"

// Functions shared by the documents, tables and pictures of one type of record.
namespace lyrefit {

struct Certificate;
struct CurveSet;
struct DataSheetFit;
struct MemberConditions;
struct TranslationReport;
struct TrendReport;

// fits_document.cc: parameters of the largest model; smaller models have the first of them.
std::vector<ParameterInfo> LargestModel(const std::vector<FittedFile>& fits);

// Final value and standard error of the parameter with this symbol.
std::pair<double, double> ValueAndError(const FitReport& report, const ParameterInfo& info);

// Whether the curves were fitted individually, without shared parameters.
inline bool OneByOne(const FamilyReport& report) { return report.estimates.empty(); }

// Title of a law: "De Soto".
inline const char* LawTitle(TranslationLaw law) {
  switch (law) {
    case TranslationLaw::kDeSoto:
      return "De Soto";
    case TranslationLaw::kPvsyst:
      return "PVsyst";
    case TranslationLaw::kCec:
      break;
  }
  return "the CEC";
}

// Parameters of an individually fitted curve, in the order of FamilyCurve::individual_parameters.
inline std::vector<ParameterInfo> FreeInfos(const FamilyReport& report) {
  std::vector<ParameterInfo> infos = MakeDevice(report.translation.spec.model, {}).parameters;
  if (report.free) AddInfos(report.with, &infos);
  return infos;
}

// record_verdicts.cc: conclusions of one or two sentences.
std::string ResidualVerdict(const ResidualStatistics& residuals);
std::string FitVerdict(const FitReport& report);
std::string FamilyVerdict(const FamilyReport& report);

// figure_blocks.cc: the picture of a record for pages, with a caption and a table of its numbers. A
// figure without panels if there is nothing to draw.
block::Figure FigureBlock(const FitReport& report);
block::Figure FigureBlock(const Diagnosis& diagnosis);
block::Figure FigureBlock(const Certificate& certificate);
block::Figure FigureBlock(const FamilyReport& report, const CurveSet& set);

// data_sheet_plot.cc: the picture of a data-sheet fit. data_sheet_document.cc: a table of some
// members by rising n.
block::Figure FigureBlock(const DataSheetFit& fit);
block::Table MemberTable(const DataSheetFit& fit);
// Conditions that differ from the reference: "200 W/m2", "50 C".
std::string ConditionsText(const MemberConditions& at);

// family_curve_document.cc: tables of curves, validation curves, and curves that were left out.
std::vector<Section> FamilyCurveSections(const FamilyReport& report);
// key_point_document.cc: results of a fit of key points; empty sections of any other.
std::vector<Section> KeyPointSections(const FamilyReport& report);

// diagnosis_document.cc: each cause with its place, size, power, alternatives and what to do.
std::vector<Section> CauseSections(const Diagnosis& diagnosis);

// diagnosis_plot.cc: adds the bands and titles of causes to a panel over voltage with known ends.
void MarkCauses(const Diagnosis& diagnosis, Panel* panel);

// diagnosis_evidence_document.cc: the reliability of a diagnosis.
std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis);

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
block::Figure FigureBlock(const TrendReport& report);

}  // namespace lyrefit
