#pragma once

#include <optional>
#include <vector>

#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/fit/fit_options.h"
#include "lyrefit/fit/fit_report.h"

namespace lyrefit {

// Curves fitted one by one.
struct IndividualFits {
  std::vector<std::optional<Expected<FitReport>>> reports;  // empty: interrupted before
  double seconds = 0;
  bool interrupted = false;
};

// How a curve of the family is fitted by itself, with the diodes alone and without intervals.
FitOptions OwnFitOptions(const FamilyOptions& options);

IndividualFits FitEveryCurve(const std::vector<const IvCurve*>& curves, const FitOptions& options,
                       int threads, const Observer& observer);

// What of a fit of its own goes into the family report, effects in the units of people.
void FillIndividualFit(const FitReport& fit, FamilyCurve* curve);

// Id, points and conditions as stated.
FamilyCurve DescribeCurve(const IvCurve& curve);

// The curves that are not left out, and what is doubtful about their readings.
CurveSet KeptCurves(const CurveSet& set, const FamilyReport& report);
std::vector<std::string> DoubtsOfKept(const CurveSet& set, const FamilyReport& report);

}  // namespace lyrefit
