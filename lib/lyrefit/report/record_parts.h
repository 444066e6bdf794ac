#pragma once

#include <utility>
#include <vector>

#include "lyrefit/diagnose/diagnosis.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/fit/fit_report.h"
#include "lyrefit/report/document.h"

// What the documents, tables and pictures of one kind of record share.
namespace lyrefit {

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

// family_curve_document.cc: curve by curve, whole curves as a test, and those that were left out.
std::vector<Section> FamilyCurveSections(const FamilyReport& report);

// diagnosis_evidence_document.cc: how far a diagnosis is to be trusted.
std::vector<Section> DiagnosisEvidenceSections(const Diagnosis& diagnosis);

}  // namespace lyrefit
