#pragma once

#include <optional>
#include <vector>

#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"

namespace lyrefit {

// Results of fitting curves individually.
struct IndividualFits {
  std::vector<std::optional<Expected<FitReport>>> reports;  // empty: interrupted before its fit
  double seconds = 0;
  bool interrupted = false;
};

// Options of an individual fit of a family curve: diodes only, without intervals.
FitOptions OwnFitOptions(const FamilyOptions& options);

IndividualFits FitEveryCurve(const std::vector<const IvCurve*>& curves, const FitOptions& options,
                             int threads, const Observer& observer);

// Copies the parts of an individual fit that the family report contains; effects in reporting
// units.
void FillIndividualFit(const FitReport& fit, FamilyCurve* curve);

// Describes a curve: id, number of points, and conditions as stated.
FamilyCurve DescribeCurve(const IvCurve& curve);

// The curves of `set` that are not left out, and the doubts about their readings.
CurveSet KeptCurves(const CurveSet& set, const FamilyReport& report);
std::vector<std::string> DoubtsOfKept(const CurveSet& set, const FamilyReport& report);

}  // namespace lyrefit
