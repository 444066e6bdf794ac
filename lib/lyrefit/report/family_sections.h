#pragma once

#include <vector>

#include "lyrefit/family/family_report.h"
#include "lyrefit/report/document.h"

// What the documents and files on a family share.
namespace lyrefit {

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

}  // namespace lyrefit
