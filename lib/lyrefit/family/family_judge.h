#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/reporting_model.h"
#include "lyrefit/family/family_model.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/family/joint.h"

namespace lyrefit {

// The end of a joint fit, with its model and its parameters in reporting units.
struct ReportedFit {
  // Keeps references to all arguments.
  ReportedFit(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end);

  const FamilyProblem& family;
  const JointProblem& problem;
  const JointEnd& end;  // in internal units
  const FamilyModel internal;
  const ReportingModel model;
  RefineEnd best;  // the end as one of `model`
};

// Offsets of the stated conditions of one fitted curve; NaN where they are no unknowns.
struct CurveOffsets {
  Interval irradiance_W_m2;
  Interval temperature_K;
};

struct JudgedEnd : JudgedFamily {
  EstimateReport estimate;                         // of the shared parameters
  std::vector<CurveOffsets> offsets;               // of the fitted curves
  std::optional<KeyPointErrors> key_point_errors;  // as the residuals show them
};

// Last stage of a family fit: parameters, intervals and figures from the end of a joint fit.
// `searched`: shared parameters of the search, in internal units. A request to stop leaves out the
// unfinished profile intervals.
JudgedEnd JudgeFamily(const ReportedFit& fit, const FamilyOptions& options,
                      const std::vector<double>& searched, const ProgressReporter& progress);

// Value, standard error and symmetric interval of a function of the shared parameters, from a
// gradient by central differences. `active`: at their bounds; `size`: number of parameters that the
// function takes. The interval is unknown if the function changes along a direction that the data
// do not determine. `standard_error`: of a function by its gradient; empty: by the covariance of
// the spread.
Interval DerivedInterval(
    const Spread& spread, const std::vector<bool>& active, int size, double t,
    const std::vector<double>& shared,
    const std::function<double(const std::vector<double>&)>& value,
    const std::function<double(const Eigen::VectorXd&)>& standard_error = nullptr);

// The interval value -+ t x standard error on the scale of `kind`, clipped to the bounds. Its ends
// are NaN without a finite standard error.
Interval SymmetricInterval(double value, double standard_error, double t,
                           ParameterKind kind = ParameterKind::kPlain,
                           const ParameterBounds& bounds = {-kInfinity, kInfinity});

// Delete-one-curve jackknife: intervals of every shared parameter if whole curves are independent,
// within the bounds of `estimates`. None if the observer stopped it.
std::optional<std::vector<Interval>> Jackknife(const ReportedFit& fit,
                                               const std::vector<Estimate>& estimates, int threads,
                                               const Observer& observer);

// Degrees of freedom: points minus free parameters, at least 1.
double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees);

}  // namespace lyrefit
