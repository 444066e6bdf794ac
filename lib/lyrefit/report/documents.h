#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/public.h"
#include "lyrefit/report/document.h"

// What there is to read of each record: as a document, drawn for a terminal of 100 columns, and in
// one line that ends with a newline. "-" stands for what is not known; every RMSE stands under its
// label, measured-current or solved-current.
namespace LYREFIT_PUBLIC lyrefit {

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

// A fit: the answer, then how far to trust it. '*' marks the objective that was fitted.
Document FitDocument(const FitReport& report);
std::string FullReport(const FitReport& report);
std::string BriefReport(const FitReport& report);

// The fits of several files, each in a row, and why others have none.
Document FitsDocument(const std::vector<FittedFile>& fits);

// A family. A report without shared parameters is that of curves fitted one by one.
Document FamilyDocument(const FamilyReport& report);
// The same with the picture of FamilyFigure(), which shows the readings of the set.
Document FamilyDocument(const FamilyReport& report, const CurveSet& set);
std::string FamilyText(const FamilyReport& report);
std::string BriefFamily(const FamilyReport& report);

// A diagnosis: the verdict first, then each cause with its size and what else it could be, then the
// evidence. Every RMSE is solved-current and says so.
Document DiagnosisDocument(const Diagnosis& diagnosis);
std::string DiagnosisText(const Diagnosis& diagnosis);
std::string BriefDiagnosis(const Diagnosis& diagnosis);

// A sweep against healthy ones: what it says, the table of now against expected, who was compared.
Document ReferenceDocument(const ReferenceComparison& comparison);
// The same, then the diagnosis.
Document ReferenceDocument(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string ReferenceText(const ReferenceComparison& comparison);
std::string BriefReference(const ReferenceComparison& comparison);

// The sweeps of a module against each other: the outliers first, each with its table; the others
// are counted. In short a line for each outlier, and one.
Document OutlierSweepsDocument(const OutlierSweeps& outlier);
std::string OutlierSweepsText(const OutlierSweeps& outlier);
std::string BriefOutlierSweeps(const OutlierSweeps& outlier);

// A certificate: what was asked, the floor and the diodes that attain it, what proves it, and how
// each model stands.
Document CertificateDocument(const Certificate& certificate);
std::string CertificateText(const Certificate& certificate);
std::string BriefCertificate(const Certificate& certificate);

// The device behind a data sheet, and what it gives of what was printed.
Document DataSheetDocument(const DataSheetFit& fit);
std::string DataSheetText(const DataSheetFit& fit);

// A curve at other conditions: the recommended result with its expanded uncertainties and the field
// test first, then all procedures side by side, the budget, the conditions of the measurement.
Document TranslationDocument(const TranslationReport& report);
std::string TranslationText(const TranslationReport& report);
std::string BriefTranslation(const TranslationReport& report);

}  // namespace lyrefit
