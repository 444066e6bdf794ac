#pragma once

#include <vector>

#include "lyrefit/law/kernel.h"
#include "lyrefit/refine/joint.h"
#include "lyrefit/refine/model.h"

namespace lyrefit {

// An unknown that a curve has to itself.
struct OwnUnknown {
  int which;  // in JointLocal
  double sd;  // of its prior, may be infinite
};
std::vector<OwnUnknown> OwnUnknowns(const JointCurve& curve);

// A joint problem as a model: one block for each curve, its priors behind its points.
class FamilyModel : public FitModel {
 public:
  // Keeps a reference.
  explicit FamilyModel(const JointProblem& problem);

  FitPoint Pack(const JointPoint& point) const;
  JointPoint Unpack(const FitPoint& point) const;

  // Derivatives of the solved current follow from the implicit function theorem at the root; those
  // of the device's parameters with respect to the unknowns from dual numbers through the
  // translation.
  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;

 private:
  const JointProblem& problem_;
  std::vector<PointSet> points_;
};

}  // namespace lyrefit
