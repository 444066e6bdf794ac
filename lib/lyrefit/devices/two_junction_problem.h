#pragma once

#include <array>
#include <vector>

#include "lyrefit/base/error.h"
#include "lyrefit/curve/curve_set.h"
#include "lyrefit/devices/two_junction_options.h"
#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/model/two_junctions.h"
#include "lyrefit/search/search_summary.h"

namespace lyrefit {

// Photocurrent of one junction in one curve: a parameter times the stated share of its light, times
// 1 + a local unknown if the share is uncertain.
struct JunctionLight {
  int photocurrent = 0;  // position of the parameter
  double share = 1;
  bool uncertain = false;
};

struct TwoJunctionCurve {
  std::vector<double> voltage_V;
  std::vector<double> current_A;
  std::array<JunctionLight, 2> light;
};

// Curves of one two-junction device at one temperature, under different lights of its junctions.
// The first parameters are those of TwoJunctionInfos; photocurrents of single curves follow.
struct TwoJunctionProblem {
  std::vector<ParameterInfo> parameters;
  std::vector<double> lower;
  std::vector<double> upper;
  std::vector<TwoJunctionCurve> curves;
  double thermal_voltage_V = 0;  // kT/q
  // The junctions are interchangeable: nothing but their order tells them apart. The parameter at
  // JunctionPhotocurrent(1) is then the excess x >= 0 in Iph2 = Iph1 (1 + x), so that junction 1 is
  // the one with the lower photocurrent.
  bool ordered = false;
  // Standard deviation of uncertain shares, relative; 0: they are exact. Their priors are residuals
  // of `noise_A` at one standard deviation.
  double light_sd = 0;
  double noise_A = 1;

  // Scales of the coordinates.
  double current_scale_A = 1;
  double voltage_scale_V = 1;  // of one junction
};

// Relative errors of the lights of one curve.
using LightErrors = std::array<double, 2>;
// Those of each curve, from the local unknowns of a point.
std::vector<LightErrors> LightErrorsOf(const TwoJunctionProblem& problem,
                                       const std::vector<double>& local);

// Parameters of the device in the light of one curve, in the order of TwoJunctionInfos.
std::array<double, kTwoJunctionParameters> DeviceIn(const TwoJunctionProblem& problem, int curve,
                                                    const double* p,
                                                    const LightErrors& errors = {});

// Parameters of the device under the reference light.
std::array<double, kTwoJunctionParameters> JunctionsAtReference(const TwoJunctionProblem& problem,
                                                                const double* p);

// The problem as a model: one block for each curve, solved-current residuals, then those of the
// priors of uncertain lights, which are local unknowns.
class TwoJunctionModel : public FitModel {
 public:
  // Keeps a reference to the problem.
  explicit TwoJunctionModel(const TwoJunctionProblem& problem);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;

 private:
  const TwoJunctionProblem& problem_;
};

// A problem of two junctions with what its starts and its report need.
struct PreparedTwoJunctions {
  TwoJunctionProblem problem;
  std::vector<StatedLight> light;  // of each curve, as used
  std::vector<double> isc_A;       // of each curve, from its readings
  double voc_V = 0;                // largest of the curves
  int free_parameters = 0;
  int readings = 0;
  double light_degrees = kInfinity;  // of freedom of `problem.light_sd`
};

// Errors: those of FitTwoJunctions.
Expected<PreparedTwoJunctions> PrepareTwoJunctions(const CurveSet& set,
                                                   const TwoJunctionOptions& options);

// Variables of the search: photocurrents in parts of what short circuit tells, the share of
// junction 1 in the open-circuit voltage, both idealities, Rs and the logarithms of the shunts. A
// saturation current follows from its junction's share of the open-circuit voltage.
Box TwoJunctionBox(const PreparedTwoJunctions& prepared);

// Parameters of the problem at a point of the box, inside the bounds.
std::vector<double> ParametersAt(const PreparedTwoJunctions& prepared, const double* x);

// Points of the box from the shape of the curves: the pairs of photocurrents that come nearest to
// the short-circuit currents of all curves, with shares of the voltage and idealities.
std::vector<std::vector<double>> TwoJunctionStarts(const PreparedTwoJunctions& prepared);

}  // namespace lyrefit
