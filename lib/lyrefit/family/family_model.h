#pragma once

#include <vector>

#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/family/joint.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {

// A local unknown of one curve.
struct OwnUnknown {
  int which;  // index into JointLocal
  double sd;  // standard deviation of its prior, may be infinite
};
std::vector<OwnUnknown> OwnUnknowns(const JointCurve& curve);

// A joint problem as a model: one block for each curve, with the residuals of its priors after
// those of its points.
class FamilyModel : public FitModel {
 public:
  // Keeps a reference to the problem.
  explicit FamilyModel(const JointProblem& problem);

  FitPoint Pack(const JointPoint& point) const;
  JointPoint Unpack(const FitPoint& point) const;

  // Derivatives of the solved current follow from the implicit function theorem at the root. Dual
  // numbers through the translation give those of the device's parameters by the unknowns.
  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;

 private:
  const JointProblem& problem_;
  std::vector<PointSet> points_;
};

}  // namespace lyrefit
