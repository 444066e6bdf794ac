#include "lyrefit/estimate/refine/refine.h"

#include <algorithm>
#include <utility>

#include "lyrefit/estimate/refine/curve_model.h"
#include "lyrefit/estimate/refine/separable.h"

namespace lyrefit {

RefineEnd Refine(const RefineProblem& problem, std::vector<double> start,
                 const RefineOptions& options) {
  const CurveModel model(problem, options.evaluation_limit ? GiveUp::kSlow : GiveUp::kAbsurd);
  return RefineModel(model, {std::move(start), {}}, options);
}

RefineEnd RefineFrom(const RefineProblem& problem, const std::vector<double>& start,
                     const RefineOptions& options) {
  constexpr double kWorse = 1e-9;  // relative rise of the mean square beyond rounding
  const double tolerance = std::max(options.function_tolerance, 1e-11);
  RefineEnd end = Refine(problem, SeparableDescent(problem, start, tolerance), options);
  if (end.mean_square <= MeanSquare(problem, start) * (1 + kWorse)) return end;
  RefineEnd own = Refine(problem, start, options);
  return own.mean_square < end.mean_square ? own : end;
}

RefineEnd RefinePlainly(const RefineProblem& problem, std::vector<double> start,
                        const RefineOptions& options) {
  const CurveModel model(problem, options.evaluation_limit ? GiveUp::kSlow : GiveUp::kAbsurd);
  return RefineModelPlainly(model, {std::move(start), {}}, options);
}

}  // namespace lyrefit
