// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// Each record as a document, as text for a terminal of 100 columns, and as one line that ends with
// a newline. "-" marks an unknown value. Every RMSE has its label, measured-current or
// solved-current.
namespace LYREFIT_PUBLIC lyrefit {

struct CellReport;
struct Certificate;
struct CurveSet;
struct DataSheetFit;
struct Diagnosis;
struct FamilyReport;
struct FitReport;
struct FittedFile;
struct ReferenceComparison;
struct OutlierSweeps;
struct TranslationReport;
struct TrendReport;
struct TwoJunctionReport;

// A fit: results, then their reliability. '*' marks the fitted objective.
Document FitDocument(const FitReport& report);
std::string FullReport(const FitReport& report);
std::string BriefReport(const FitReport& report);

// The fits of several files, one row for each, and the reasons of those that failed.
Document FitsDocument(const std::vector<FittedFile>& fits);

// A family fit. A report without shared parameters is one of curves fitted individually.
Document FamilyDocument(const FamilyReport& report);
// With the picture of FamilyFigure(), which shows the readings of `set`.
Document FamilyDocument(const FamilyReport& report, const CurveSet& set);
std::string FamilyText(const FamilyReport& report);
std::string BriefFamily(const FamilyReport& report);

// A fit of two junctions: parameters, which measurement would decide those that are not
// identifiable, and every curve with its light and the junction that limits.
Document TwoJunctionDocument(const TwoJunctionReport& report);
std::string TwoJunctionText(const TwoJunctionReport& report);
std::string BriefTwoJunctions(const TwoJunctionReport& report);

// A diagnosis: the verdict, each cause with its place, size, power and what to do, then, folded,
// parameters and evidence. Every RMSE is solved-current and labelled so.
Document DiagnosisDocument(const Diagnosis& diagnosis);
// The text without or with the folded sections.
enum class Length { kShort, kWhole };
std::string DiagnosisText(const Diagnosis& diagnosis, Length length = Length::kShort);
std::string BriefDiagnosis(const Diagnosis& diagnosis);

// A sweep against reference sweeps: conclusion, table of measured and expected values, sweeps used.
Document ReferenceDocument(const ReferenceComparison& comparison);
// With the diagnosis after the comparison.
Document ReferenceDocument(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string ReferenceText(const ReferenceComparison& comparison);
std::string BriefReference(const ReferenceComparison& comparison);

// Outliers among the sweeps of a module: each outlier with its table, the others as a count. The
// brief text has one line for each outlier and a last line with the count.
Document OutlierSweepsDocument(const OutlierSweeps& outlier);
std::string OutlierSweepsText(const OutlierSweeps& outlier);
std::string BriefOutlierSweeps(const OutlierSweeps& outlier);

// A certificate: the problem, the floor and its diodes, the proof, and each model's distance from
// the floor.
Document CertificateDocument(const Certificate& certificate);
std::string CertificateText(const Certificate& certificate);
std::string BriefCertificate(const Certificate& certificate);

// A laboratory cell: sweeps, hysteresis, ideality, series resistance, losses of the fill factor,
// superposition. The brief text has its main figures.
Document CellDocument(const CellReport& report);
std::string CellText(const CellReport& report);
std::string BriefCell(const CellReport& report);

// The device fitted to a data sheet, and its values beside the printed ones.
Document DataSheetDocument(const DataSheetFit& fit);
std::string DataSheetText(const DataSheetFit& fit);

// A translated curve: the recommended result with its expanded uncertainties and the field test,
// then all procedures, the budget, and the conditions of the measurement.
Document TranslationDocument(const TranslationReport& report);
std::string TranslationText(const TranslationReport& report);
std::string BriefTranslation(const TranslationReport& report);

// What changed in a device over time: losses by part, steps and onsets, rates. The brief text is the
// verdict.
Document TrendDocument(const TrendReport& report);
std::string TrendText(const TrendReport& report);
std::string BriefTrend(const TrendReport& report);

}  // namespace lyrefit
