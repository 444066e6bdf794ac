#pragma once

#include <array>
#include <vector>

#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/model/two_junctions.h"

namespace lyrefit {

// Photocurrent of one junction in one curve: a parameter times the stated share of its light.
struct JunctionLight {
  int photocurrent = 0;  // position of the parameter
  double share = 1;
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

  // Scales of the coordinates.
  double current_scale_A = 1;
  double voltage_scale_V = 1;  // of one junction
};

// Parameters of the device in the light of one curve, in the order of TwoJunctionInfos.
std::array<double, kTwoJunctionParameters> DeviceIn(const TwoJunctionProblem& problem, int curve,
                                                    const double* p);

// Parameters of the device under the reference light.
std::array<double, kTwoJunctionParameters> JunctionsAtReference(const TwoJunctionProblem& problem,
                                                                const double* p);

// The problem as a model: one block for each curve, solved-current residuals, no local unknowns.
class TwoJunctionModel : public FitModel {
 public:
  // Keeps a reference to the problem.
  explicit TwoJunctionModel(const TwoJunctionProblem& problem);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;

 private:
  const TwoJunctionProblem& problem_;
};

}  // namespace lyrefit
