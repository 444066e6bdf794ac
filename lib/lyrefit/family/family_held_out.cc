#include "lyrefit/family/family_held_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lyrefit/base/parallel.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/fit/statistics.h"

namespace lyrefit {
namespace {

// One curve (a position in the set) and how well it was predicted.
struct Tested {
  int curve = 0;
  double points = 0;
  RmsePair rmse;
};

bool CanBeTested(const JointCurve& curve) {
  return std::isfinite(curve.irradiance_sd) && std::isfinite(curve.temperature_sd_K);
}

std::vector<Tested> Predict(const FamilyProblem& family, const FamilyOptions& options,
                            const std::vector<double>& shared, const std::vector<int>& curves) {
  std::vector<int> known;
  for (const int c : curves) {
    if (CanBeTested(family.curves.members[c].joint)) known.push_back(c);
  }
  const JointProblem problem = JointProblemOn(family, options, known);
  const JointPoint point{shared, std::vector<JointLocal>(known.size(), {0, 0})};
  std::vector<Tested> tested;
  for (std::size_t k = 0; k < known.size(); ++k) {
    tested.push_back({known[k], static_cast<double>(problem.curves[k].voltage_V.size()),
                      CurveRmse(problem, point, static_cast<int>(k))});
  }
  return tested;
}

HeldOut Summarise(const std::vector<Tested>& tested, const CurveSet& set) {
  HeldOut result;
  result.curves = static_cast<int>(tested.size());
  if (tested.empty()) return result;
  double measured = 0, solved = 0, points = 0;
  std::vector<double> rmse;
  result.largest_rmse_A = -1;
  for (const Tested& one : tested) {
    measured += one.points * one.rmse.measured_current_A * one.rmse.measured_current_A;
    solved += one.points * one.rmse.solved_current_A * one.rmse.solved_current_A;
    points += one.points;
    rmse.push_back(one.rmse.solved_current_A);
    if (one.rmse.solved_current_A <= result.largest_rmse_A) continue;
    result.largest_rmse_A = one.rmse.solved_current_A;
    result.largest_id = set.curves[one.curve].name;
  }
  result.rmse = {std::sqrt(measured / points), std::sqrt(solved / points)};
  result.median_rmse_A = Median(std::move(rmse));
  return result;
}

}  // namespace

HeldOut TestOn(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
               const std::vector<double>& shared, const std::vector<int>& curves) {
  HeldOut result = Summarise(Predict(family, options, shared, curves), set);
  result.how = fmt::format("{} curves that were not fitted", result.curves);
  return result;
}

HeldOut TestByFolds(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
                    const JointProblem& problem, const JointEnd& end) {
  const std::vector<int>& fitted = family.curves.fitted;
  const int folds = std::min(options.folds, static_cast<int>(fitted.size()));
  std::vector<std::vector<Tested>> parts(folds);
  ParallelFor(folds, options.threads, [&](int f) {
    std::vector<int> kept, left;
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      (static_cast<int>(k) % folds == f ? left : kept).push_back(fitted[k]);
    }
    JointProblem rest = JointProblemOn(family, options, kept);
    rest.noise_A = problem.noise_A;
    const JointPoint start{end.point.shared, std::vector<JointLocal>(kept.size(), {0, 0})};
    JointOptions quick;
    quick.function_tolerance = 1e-10;
    const JointEnd refit = RefineJointly(rest, start, quick);
    parts[f] = Predict(family, options, refit.point.shared, left);
  });
  std::vector<Tested> tested;
  for (const auto& part : parts) tested.insert(tested.end(), part.begin(), part.end());
  HeldOut result = Summarise(tested, set);
  result.how = fmt::format("{} folds of whole curves", folds);
  return result;
}

}  // namespace lyrefit
