#pragma once

#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/model/reporting_units.h"

namespace lyrefit {

// A model with the parameters of effects in reporting units. A reporting value may depend on other
// parameters (the strength k of k |V|^m depends on m), so intervals are found in these units. Fits
// use internal units, since such parameters are strongly correlated in reporting units. Without
// effects it is the internal model.
class ReportingModel : public FitModel {
 public:
  // Keeps references to the model and the effects.
  ReportingModel(const FitModel& internal, const EffectSpan& effects);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;
  double MeanSquare(const FitPoint& point) const override;

 private:
  const FitModel& internal_;
  EffectSpan effects_;
};

}  // namespace lyrefit
