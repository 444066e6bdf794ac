#pragma once

#include <memory>

#include "lyrefit/law/law.h"
#include "lyrefit/refine/model.h"
#include "lyrefit/refine/problem.h"

namespace lyrefit {

// One curve of a device as a model: one block without unknowns of its own, mean squares by the
// kernel.
class CurveModel : public FitModel {
 public:
  // Keeps a reference.
  explicit CurveModel(const RefineProblem& problem);
  // For one descent, in which each evaluation may start where the last one ended: faster for
  // extended devices, and not for several threads at once.
  CurveModel(const RefineProblem& problem, GiveUp give_up);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;
  double MeanSquare(const FitPoint& point) const override;
  std::unique_ptr<FitModel> Coarse() const override;

 private:
  explicit CurveModel(std::unique_ptr<RefineProblem> own);

  std::unique_ptr<RefineProblem> own_;  // null: somebody else's
  const RefineProblem& problem_;
  std::unique_ptr<LawWorkspace> kept_;  // null: evaluations know nothing of each other
};

}  // namespace lyrefit
