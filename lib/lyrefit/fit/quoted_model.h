#pragma once

#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/profile.h"

namespace lyrefit {

// The problem of one curve with the parameters of effects in reporting units. A reporting value may
// depend on other parameters (the strength k of k |V|^m depends on m), so intervals are found in
// these units. Fits use internal units, since such parameters are strongly correlated in reporting
// units.
class QuotedModel : public FitModel {
 public:
  // `problem` is of a device with effects and must outlive the model.
  explicit QuotedModel(const RefineProblem& problem);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;
  double MeanSquare(const FitPoint& point) const override;

 private:
  const RefineProblem& problem_;
  CurveModel own_;
};

// FindProfileSide() for a parameter of an effect. Values of `query` and result are in reporting
// units; `best`, the local optima and `better` of the result are in internal units.
ProfileSide FindQuotedSide(const RefineProblem& problem, const RefineEnd& best,
                           const ProfileQuery& query, const StopToken& stop);

// FindOtherOptima() for one curve, all in internal units.
std::vector<FitPoint> FindOtherOptima(const RefineProblem& problem, const RefineEnd& best,
                                      std::vector<FitPoint> ends, double highest,
                                      const StopToken& stop);

// Marks the enumerated parameters of effects that cannot be found by descent, since no current
// depends on them locally at `quoted`. An example is the moment of a step between two readings.
std::vector<bool> FindFlat(const RefineProblem& problem, const std::vector<double>& quoted);

}  // namespace lyrefit
