#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/fit_two_junctions.h"
#include "lyrefit/devices/two_junction_problem.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/refine/active_set.h"

// Whether two junctions in the stated lights explain their curves, and what their lights may miss.
namespace lyrefit {

// Compares the residuals with the noise that differences of neighbouring readings show. NaN: too few
// readings, or residuals of rounding alone.
JunctionTest TestJunctions(const PreparedTwoJunctions& prepared, const FitPoint& point);

// Whether the residuals are more than noise.
bool IsMissed(const JunctionTest& test);

// p-value of what errors of the stated lights explain, if the lights are exact (F-test). NaN: no light
// may err, or the readings are exact.
double PValueOfExactLights(const PreparedTwoJunctions& prepared, double noise_A,
                           const RefineEnd& exact, const StopToken& stop);

// What the tests of a report say, and what to do.
std::vector<std::string> TestWarnings(const TwoJunctionReport& report);

// The problem with uncertain lights of the standard deviation `sd`; NaN: of 2 %.
PreparedTwoJunctions WithUsualLights(PreparedTwoJunctions prepared, double sd, double noise_A);

// The problem with uncertain lights of the standard deviation `sd`. NaN: of the one that its fit from
// `point` shows, by expectation and maximisation (Dempster, Laird and Rubin 1977,
// doi:10.1111/j.2517-6161.1977.tb01600.x), with a prior of 2 % worth two lights: one or two lights
// show, the curves leave the others open.
PreparedTwoJunctions WithUncertainLights(PreparedTwoJunctions prepared, double sd, double noise_A,
                                         const FitPoint& point, const StopToken& stop);

// Errors of the readings and of uncertain lights at the end of a fit. Where a standard error is of
// lights whose size was found, its t is of their degrees of freedom (Satterthwaite 1946,
// doi:10.2307/3002019).
EstimateErrors ErrorsUnderLights(const PreparedTwoJunctions& prepared, const RefineEnd& end);

// The end of a fit of two junctions without intervals.
RefineEnd EndOfJunctions(const PreparedTwoJunctions& prepared, const TwoJunctionOptions& options,
                         const Observer& observer);

// Two curves whose stated lights fit far better when exchanged. None: there are none.
std::optional<ExchangedLights> FindExchangedLights(const CurveSet& set,
                                                   const TwoJunctionOptions& options,
                                                   const PreparedTwoJunctions& prepared,
                                                   double rmse_A, const Observer& observer);

}  // namespace lyrefit
