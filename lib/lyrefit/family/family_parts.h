#pragma once

#include <string>
#include <vector>

#include "lyrefit/curve/curve_set.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/report/document.h"

// Functions shared by the documents, tables and pictures of a fit of many curves.
namespace lyrefit {

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

// family_document.cc: the conclusion in one or two sentences.
std::string FamilyVerdict(const FamilyReport& report);

// family_plot.cc: the picture for pages, with a caption and a table of its numbers. A figure without
// panels if there is nothing to draw.
block::Figure FigureBlock(const FamilyReport& report, const CurveSet& set);

// family_curve_document.cc: tables of curves, validation curves, and curves that were left out.
std::vector<Section> FamilyCurveSections(const FamilyReport& report);
// key_point_document.cc: results of a fit of key points; empty sections of any other.
std::vector<Section> KeyPointSections(const FamilyReport& report);

}  // namespace lyrefit
