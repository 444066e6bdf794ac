#pragma once
// Stages of a family fit. Each is a value made from those before it.

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/fit_options.h"
#include "lyrefit/estimate/fit/fit_report.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/family_options.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/family/joint_fit.h"

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

// First stage: the law, the curves and their bounds. The set and the options must outlive it.
struct PreparedFamily {
  const CurveSet& set;
  const FamilyOptions& options;
  FamilyProblem family;
  std::vector<int> search_curves;  // positions in the set
};

// Checks the set and the options. Errors: those of FitFamily().
Expected<PreparedFamily> PrepareFamily(const CurveSet& set, const FamilyOptions& options);

// Individual fits of the curves, and the starts of the joint fit that those of the search curves
// give. Without FamilyOptions::individual_fits only the search curves are fitted.
struct CurvesAlone {
  std::vector<int> curves;  // positions in the set
  IndividualFits fits;      // of these curves
  std::vector<JointPoint> starts;
};
CurvesAlone FitCurvesAlone(const PreparedFamily& prepared, const Observer& observer);

// The joint fit on all fitted curves.
struct RefinedFamily {
  FamilyProblem family;  // with the selected weights, and integers fixed at their values
  JointProblem problem;
  JointEnd end;
  WeightChoice weights;
  double searched_key_points = kUnknown;   // KeyPointRms of the search's parameters
  RmsePair searched;                       // of the search's parameters, on all fitted curves
  std::optional<CandidateEnds> candidate;  // if requested (FamilyOptions::plain_polish)
  double seconds = 0;                      // of the joint fit, from all its starts
};

// Fits all curves jointly from the search's candidates and from the starts of the individual fits.
RefinedFamily RefineFamily(const PreparedFamily& prepared, const FamilySearchEnd& searched,
                           const std::vector<JointPoint>& individual_starts,
                           const Observer& observer);

// Error: parameters to test (`options.against`) whose number of cells differs from that of the set.
Expected<void> CheckAgainst(const FamilyProblem& family, const FamilyOptions& options);

// Tests the joint fit on whole curves at their stated conditions: on the held-out curves, or by
// cross-validation over folds. Tests the parameters of `options.against` on the same curves. Curves
// without stated conditions are not tested. `curves`: the rows of all curves of the set, with their
// individual fits. None if the observer stopped it.
std::optional<FamilyTests> TestFamily(const PreparedFamily& prepared, const RefinedFamily& refined,
                                      const std::vector<FamilyCurve>& curves,
                                      const Observer& observer);

// Root mean square of the residuals of key points over all curves of a problem, in units of their
// errors.
double KeyPointRms(const JointProblem& problem, const JointPoint& point);

// Measured and fitted key points of every curve of a joint fit of key points, with the held-out
// powers of `tests`. `rows`: the curves of the set, with their parameters.
std::vector<FamilyCurve> WithKeyPoints(std::vector<FamilyCurve> rows, const RefinedFamily& refined,
                                       const std::vector<double>& shared, const FamilyTests& tests);

// Summarises the fitted curves of `rows` of a judged fit.
KeyPointSummary SummariseKeyPoints(const std::vector<FamilyCurve>& rows,
                                   const RefinedFamily& refined, const FamilyOptions& options,
                                   const JudgedEnd& judged);

// Devices that fit as well along the parameter that the key points determine least: one that is
// not identifiable, or the ideality if its interval is wider than a third of its value. None if
// there is no such parameter or the observer stopped it.
std::optional<EqualDevices> FindEqualDevices(const RefinedFamily& refined,
                                             const std::vector<Estimate>& estimates,
                                             const Observer& observer);

// Warnings that the reader of a report needs, as plain sentences.
std::vector<std::string> FamilyWarnings(const FamilyReport& report, const FamilyOptions& options);

}  // namespace lyrefit
