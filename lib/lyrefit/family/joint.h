#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/spread.h"
#include "lyrefit/model/model_points.h"
#include "lyrefit/model/translation.h"

namespace lyrefit {

// Key points measured under one condition, and their errors: residual = (model / value - 1) / error
// in units of the noise. Isc, Voc, Vmp and Pmp (KeyPointRow); Imp = Pmp / Vmp says nothing more. A
// value that is NaN has no residual. The residual of Vmp is dP/dV = 0 there, in volt.
struct KeyPointResiduals {
  KeyPointValues value;
  KeyPointValues error;  // relative standard deviations

  int size() const;  // number of values
};

// One curve of a joint problem and its local unknowns u and d: true irradiance = stated (1 + u),
// true temperature = stated + d.
struct JointCurve {
  std::vector<double> voltage_V;
  std::vector<double> current_A;
  std::vector<double> weight;  // of the squared residuals; 1 is a point of ordinary weight
  // Residuals of key points in place of those of the points.
  std::optional<KeyPointResiduals> key_points;
  double irradiance_W_m2 = 0;  // as stated, above 0 (but see `extended`)
  double temperature_K = 0;
  // With effects: the translation's device under this curve's conditions. The curve then has no
  // local unknowns, and its irradiance may be 0.
  std::shared_ptr<const Device> extended;
  // Standard deviation of the unknown's prior around 0; 0: no such unknown, infinite: no prior.
  double irradiance_sd = 0;  // of u
  double temperature_sd_K = 0;

  int residuals() const;  // without those of priors
};

using JointLocal = std::array<double, 2>;  // u, d in kelvin

// Curves of one device: minimise the sum of weight x residual^2 over all points, plus (noise x
// local / sd)^2 for every local unknown with a prior. Residuals of key points count in units of
// `key_point_scale_A`, so that one of one error is as large as a point's residual of that size.
struct JointProblem {
  Translation translation;
  Objective objective = Objective::kSolvedCurrent;
  std::vector<JointCurve> curves;
  // Bounds of the shared parameters in the translation's order, then of the sensors' common errors:
  // true irradiance = stated + first (W/m2), true temperature = stated + second (K). Equal bounds:
  // fixed.
  std::vector<double> lower;
  std::vector<double> upper;
  double key_point_scale_A = 1;
  double noise_A = 1;  // standard deviation of a point of weight 1, which scales the priors

  // Scales of the coordinates.
  double current_scale_A = 1;
  double voltage_scale_V = 1;

  int shared() const { return translation.size() + 2; }
  int irradiance_offset() const { return translation.size(); }
  int temperature_offset() const { return translation.size() + 1; }
};

// Fills the scales from the curves.
void FindJointScales(JointProblem* problem);

struct JointPoint {
  std::vector<double> shared;     // followed by the two sensor errors
  std::vector<JointLocal> local;  // of each curve; 0 without such an unknown
};

// Irradiance and temperature of a curve at a point of the problem.
struct TrueConditions {
  double irradiance_W_m2;
  double temperature_K;
};
TrueConditions ConditionsAt(const JointProblem& problem, const JointPoint& point, int curve);

// The device of a curve: the translation's, or with effects the curve's own.
const Device& DeviceOf(const JointProblem& problem, int curve);

// Parameters of DeviceOf at a point of the problem.
std::vector<double> DeviceAt(const JointProblem& problem, const JointPoint& point, int curve);

struct JointEnd {
  JointPoint point;
  double squares = 0;        // weighted sum over the points, A^2
  double prior_squares = 0;  // sum of squares of the priors
  bool converged = false;
  bool stopped = false;  // by `stop`
  int iterations = 0;
  std::vector<bool> active;       // see RefineEnd
  double projected_gradient = 1;  // of the shared parameters, see RefineEnd
};

struct JointOptions {
  double function_tolerance = 1e-15;  // as in RefineOptions
  StopToken stop;  // polled once per iteration; a stop ends the fit at the best point so far
};

// RefineModel of a joint problem. Only the saturation current of a second diode may vanish. Its
// result is then a negligible positive value, so that the logarithm is finite.
JointEnd RefineJointly(const JointProblem& problem, const JointPoint& start,
                       const JointOptions& options = {});

// The end as one of the joint problem's FamilyModel.
RefineEnd PackedEnd(const JointProblem& problem, const JointEnd& end);

// The options of RefineModel for a joint problem.
RefineOptions HowToRefine(const JointOptions& options);

// RefineModelPlainly of a joint problem.
JointEnd RefineJointlyPlainly(const JointProblem& problem, const JointPoint& start,
                              const JointOptions& options = {});

// FindSpread of a joint problem at the end of its fit; `variance` is that of a point of weight 1.
struct JointSpread : Spread {
  std::vector<JointLocal> local_errors;  // standard errors of the curves' local unknowns
  double local_degrees = 0;  // degrees of freedom of the local unknowns beyond their priors
};
JointSpread FindJointSpread(const JointProblem& problem, const JointEnd& end, double variance);
// FindJointSpread in the units of `model`, which is a FamilyModel or wraps one, and of `end`.
JointSpread FindJointSpread(const JointProblem& problem, const FitModel& model,
                            const RefineEnd& end, double variance);

// Finds curves that do not belong to the device of the others (positions among the problem's
// curves). A robust fit misses such a curve by far more than the other curves, by a visible amount,
// and by more than ordinary errors of its irradiance and temperature explain. `stop` is polled
// as in JointOptions; after a stop the result is meaningless.
std::vector<int> FindOutlierCurves(const JointProblem& problem, const JointEnd& end,
                                   const StopToken& stop = {});

}  // namespace lyrefit
