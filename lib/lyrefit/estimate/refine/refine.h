#pragma once

#include <memory>
#include <vector>

#include "lyrefit/estimate/refine/active_set.h"
#include "lyrefit/estimate/refine/model.h"
#include "lyrefit/estimate/refine/problem.h"
#include "lyrefit/model/law.h"

namespace lyrefit {

// One curve of a device as a model: one block without local unknowns. The kernel computes mean
// squares.
class CurveModel : public FitModel {
 public:
  // Keeps a reference to the problem.
  explicit CurveModel(const RefineProblem& problem);
  // For one descent: each evaluation may start from the last solution. Faster for devices with
  // effects; not thread-safe.
  CurveModel(const RefineProblem& problem, GiveUp give_up);

  bool Evaluate(int block, const double* p, const double* local, double* residuals, double* slopes,
                double* local_slopes) const override;
  double MeanSquare(const FitPoint& point) const override;
  std::unique_ptr<FitModel> Coarse() const override;

 private:
  explicit CurveModel(std::unique_ptr<RefineProblem> own);

  std::unique_ptr<RefineProblem> own_;  // null: the caller owns the problem
  const RefineProblem& problem_;
  std::unique_ptr<LawWorkspace> kept_;  // null: evaluations are independent
};

// RefineModel of one curve.
RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options = {});

// SeparableDescent, with the tolerance of `options` but at least 1e-11, then Refine. Never ends
// above `start`: if the descent ends higher, Refine runs from `start` itself.
RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options = {});

// RefineModelPlainly of one curve.
RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options = {});

}  // namespace lyrefit
