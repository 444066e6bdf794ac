#pragma once

#include "lyrefit/base/observer.h"
#include "lyrefit/family/family_problem.h"
#include "lyrefit/family/family_report.h"
#include "lyrefit/refine/family_model.h"
#include "lyrefit/refine/joint.h"
#include "lyrefit/refine/reporting_model.h"

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

// Fills estimates, sensor errors, coefficients, correlations, key points at the reference, curve
// offsets and the noise of `report` from the end of a joint fit. All values are in reporting units
// except `report->refined`, which is in internal units. If the observer stops it, it omits
// the unfinished profile intervals and marks the report as interrupted.
void JudgeFamily(const ReportedFit& fit, const FamilyOptions& options, const Observer& observer,
                 FamilyReport* report);

// The interval value -+ t x standard error on the scale of `kind`, clipped to the bounds. Its ends are
// NaN without a finite standard error.
Interval SymmetricInterval(double value, double standard_error, double t,
                           ParameterKind kind = ParameterKind::kPlain,
                           const ParameterBounds& bounds = {-kInfinity, kInfinity});

// Delete-one-curve jackknife: intervals of every shared parameter if whole curves are independent.
// If the observer stops it, it marks the report as interrupted and fills nothing.
void Jackknife(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end,
               int threads, const Observer& observer, FamilyReport* report);

// Degrees of freedom: points minus free parameters, at least 1.
double JointDegrees(const JointProblem& problem, int free_parameters, double local_degrees);

}  // namespace lyrefit
