#pragma once

#include <functional>
#include <vector>

#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/profile.h"

namespace lyrefit {

// The problem of one curve with the effects' parameters in the units of reports. What is reported
// of one may depend on others (the strength k of k |V|^m on m), so intervals of what is reported
// are found in these numbers; fits are not, since there such parameters hang together.
class QuotedModel : public FitModel {
 public:
  // `problem`, of a device with effects, must outlive the model.
  explicit QuotedModel(const RefineProblem& problem);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;
  double MeanSquare(const FitPoint& point) const override;

 private:
  const RefineProblem& problem_;
  CurveModel own_;
};

// FindProfileSide of an effect's parameter, all in these numbers but `best` and the local optima.
ProfileSide FindQuotedSide(const RefineProblem& problem, const RefineEnd& best,
                           const ProfileQuery& query, const std::function<bool()>& stop);

// FindOtherOptima of one curve. None of it is in these numbers.
std::vector<FitPoint> FindOtherOptima(const RefineProblem& problem, const RefineEnd& best,
                                  std::vector<FitPoint> ends, double highest,
                                  const std::function<bool()>& stop);

// Which parameters of effects are settled by trying and not by descent, since at `quoted` no
// current follows them: the moment of a step between two readings.
std::vector<bool> FindFlat(const RefineProblem& problem, const std::vector<double>& quoted);

}  // namespace lyrefit
