// Experimental: may change in a minor version (data/stable).
#pragma once

#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/public.h"
#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/diagnose/reference.h"
#include "lyrefit/report/document.h"
#include "lyrefit/report/figure.h"

// Diagnoses and comparisons with reference sweeps as documents, as text, JSON, CSV and pictures. The
// conventions are those of report/documents.h, json.h, csv.h and plots.h.
namespace LYREFIT_PUBLIC lyrefit {

// A diagnosis: the verdict, each cause with its place, size, power and what to do, then, folded,
// parameters and evidence. Every RMSE is solved-current and labelled so.
Document DiagnosisDocument(const Diagnosis& diagnosis);
std::string DiagnosisText(const Diagnosis& diagnosis, Length length = Length::kWhole);
std::string BriefDiagnosis(const Diagnosis& diagnosis);

// A sweep against reference sweeps: conclusion, table of measured and expected values, sweeps used.
Document ReferenceDocument(const ReferenceComparison& comparison);
// With the diagnosis after the comparison.
Document ReferenceDocument(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string ReferenceText(const ReferenceComparison& comparison);
std::string BriefReference(const ReferenceComparison& comparison);

// Outliers among the sweeps of a module: each outlier with its table, the others as a count. The
// brief text has one line for each outlier and a last line with the count.
Document OutlierSweepsDocument(const OutlierSweeps& outliers);
std::string OutlierSweepsText(const OutlierSweeps& outliers);
std::string BriefOutlierSweeps(const OutlierSweeps& outliers);

// A diagnosis, which refers to points by index into `points`. Several diagnoses form an array.
std::string DiagnosisJson(const Diagnosis& diagnosis);
std::string DiagnosisJson(const std::vector<Diagnosis>& diagnoses);

// Only the causes, for scripts that score many diagnoses: {"name": [["cause", "equivalent", ...],
// ...]} with an empty list where no cause was found. `names` has one name for each diagnosis.
std::string AnswersJson(const std::vector<std::string>& names,
                        const std::vector<Diagnosis>& diagnoses);

// The comparison and the diagnosis of its remainder.
std::string ReferenceJson(const ReferenceComparison& comparison, const Diagnosis& diagnosis);
std::string OutlierSweepsJson(const OutlierSweeps& outliers);

// One row for each cause, with those below the floor after the named ones. A measurement without a
// cause has one row with its name and the verdict only.
std::string CausesCsv(const std::vector<std::string>& names,
                      const std::vector<Diagnosis>& diagnoses);

// One row for each sweep, the strongest outlier first.
std::string OutlierSweepsCsv(const OutlierSweeps& outliers);

// A diagnosis, coloured by curve, or by direction if one curve was swept both ways. Above: measured
// points, base model and the model with causes. Below: the residuals of both in % of Isc. A band in
// the cause's colour marks where it acts most, with its title below.
Figure DiagnosisFigure(const Diagnosis& diagnosis);
Expected<void> PlotDiagnosis(const Diagnosis& diagnosis, const std::string& path,
                             PlotPoints points = PlotPoints::kThinned);

}  // namespace lyrefit
