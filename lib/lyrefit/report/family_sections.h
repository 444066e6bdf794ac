#pragma once

#include <string>

#include "lyrefit/family/family_report.h"

// The sections of the text report on a family; each ends with a newline or is empty where there is
// nothing to say.
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

// family_answer_text.cc: what came out.
std::string FamilyParameterSection(const FamilyReport& report);
std::string FamilySensorSection(const FamilyReport& report);
std::string FamilyReferenceSection(const FamilyReport& report);
std::string FamilyRmseSection(const FamilyReport& report);

// family_curve_text.cc: curve by curve.
std::string FamilyCurveSection(const FamilyReport& report);
std::string FamilyOffsetSection(const FamilyReport& report);
std::string FreeFitSection(const FamilyReport& report);

// family_held_out_text.cc: whole curves as a test, of parameters from elsewhere too.
std::string FamilyHeldOutSection(const FamilyReport& report);

// family_evidence_text.cc: how far to trust it.
std::string FamilyCandidateSection(const FamilyReport& report);
std::string FamilyOddSection(const FamilyReport& report);
std::string FamilyOutSection(const FamilyReport& report);
std::string FamilySearchSection(const FamilyReport& report);

}  // namespace lyrefit
