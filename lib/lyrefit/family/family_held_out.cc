#include "lyrefit/family/refine_family.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/median.h"
#include "lyrefit/base/parallel.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/family_search.h"
#include "lyrefit/family/key_point_errors.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

// One curve (a position in the set) and its prediction error.
struct Tested {
  int curve = 0;
  double points = 0;
  RmsePair rmse;
};

bool CanBeTested(const JointCurve& curve) {
  return std::isfinite(curve.irradiance_sd) && std::isfinite(curve.temperature_sd_K);
}

std::vector<Tested> Predict(const FamilyProblem& family, const FamilyOptions& options,
                            const Translation& translation, const std::vector<double>& shared,
                            const std::vector<int>& curves) {
  std::vector<int> known;
  for (const int c : curves) {
    if (CanBeTested(family.curves.members[c].joint)) known.push_back(c);
  }
  JointProblem problem = JointProblemOn(family, options, known);
  problem.translation = translation;
  const JointPoint point{shared, std::vector<JointLocal>(known.size(), {0, 0})};
  std::vector<Tested> tested;
  for (std::size_t k = 0; k < known.size(); ++k) {
    tested.push_back({known[k], static_cast<double>(problem.curves[k].voltage_V.size()),
                      CurveRmse(problem, point, static_cast<int>(k))});
  }
  return tested;
}

// Errors of key points as the fitted curves of a problem show them; the others follow in it.
struct ForecastErrors {
  std::optional<KeyPointRowsOf> rows;
  std::optional<KeyPointErrorSizes> sizes;
};

ForecastErrors ErrorsOfForecasts(const JointProblem& all, const JointEnd& refit, std::size_t fitted,
                                 double noise, const KeyPointErrors& stated) {
  ForecastErrors errors;
  std::vector<bool> used(all.curves.size(), false);
  std::fill_n(used.begin(), fitted, true);
  errors.rows = RowsOfKeyPoints(all, {refit.point.shared, {}}, refit.active, used);
  if (errors.rows && noise > 0) errors.sizes.emplace(*errors.rows, noise, stated);
  return errors;
}

// Half of the 95 % interval of a measured Pmp less its forecast. `gradient`: of the forecast;
// `curve`: position in the problem of the errors; `own_W`: error of Pmp per unit of its residual.
double HalfWidthOf(const ForecastErrors& errors, const Eigen::VectorXd& gradient, std::size_t curve,
                   double own_W) {
  const KeyPointRowsOf& rows = *errors.rows;
  Eigen::VectorXd weight = TransposedTimes(rows.influence, gradient);
  for (int r = rows.first[curve]; r < rows.first[curve + 1]; ++r) {
    if (rows.kind[r] == kPmpRow) weight[r] = -own_W;
  }
  return errors.sizes->HalfWidth95(rows, weight);
}

// Pmp of curves `left` that `refit` on the curves `kept` did not see, with the interval of a
// measurement.
std::vector<std::pair<int, Interval>> PredictPower(const FamilyProblem& family,
                                                   const FamilyOptions& options,
                                                   const JointProblem& problem,
                                                   const JointEnd& refit, std::vector<int> kept,
                                                   const std::vector<int>& left) {
  const double degrees = JointDegrees(problem, family.free_parameters, 0);
  const double variance = refit.squares / degrees;
  const double t = StudentT95(static_cast<int>(degrees));
  const JointSpread spread = FindJointSpread(problem, refit, variance);
  const std::size_t fitted = kept.size();
  kept.insert(kept.end(), left.begin(), left.end());
  const ForecastErrors errors =
      ErrorsOfForecasts(JointProblemOn(family, options, kept), refit, fitted, std::sqrt(variance),
                        options.key_point_errors);
  std::vector<std::pair<int, Interval>> predicted;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const JointCurve& curve = family.curves.members[left[k]].joint;
    const auto power = [&](const std::vector<double>& shared) {
      const TranslatedDevice at = TranslateTo(
          problem.translation, shared, curve.irradiance_W_m2 + shared[problem.irradiance_offset()],
          curve.temperature_K + shared[problem.temperature_offset()]);
      return ModelKeyPoints(at.device, at.parameters.data()).max_power_W;
    };
    const double own = curve.key_points->error[kPmpRow] * std::fabs(power(refit.point.shared)) /
                       problem.key_point_scale_A;
    const auto standard_error = [&](const Eigen::VectorXd& gradient) {
      if (errors.sizes) return HalfWidthOf(errors, gradient, fitted + k, own) / t;
      return std::sqrt(gradient.dot(spread.covariance * gradient) + variance * own * own);
    };
    predicted.push_back({left[k], DerivedInterval(spread, refit.active, problem.shared(), t,
                                                  refit.point.shared, power, standard_error)});
  }
  return predicted;
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
  result.median_rmse_A = UpperMedian(rmse);
  result.curve_rmse_A = std::move(rmse);
  return result;
}

// `shared` includes both sensor errors at its end.
HeldOut TestOn(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
               const std::vector<double>& shared, const std::vector<int>& curves) {
  HeldOut result = Summarise(Predict(family, options, family.translation, shared, curves), set);
  result.how = fmt::format("{} curves that were not fitted", result.curves);
  return result;
}

// Parameters from another source include no sensor errors, which are therefore 0.
Against TestAgainst(const CurveSet& set, const FamilyProblem& family, const FamilyOptions& options,
                    const NamedParameters& elsewhere, const std::vector<int>& curves) {
  std::vector<double> shared = elsewhere.shared;
  shared.insert(shared.end(), {0, 0});  // both sensor errors
  const bool pvsyst = elsewhere.translation.spec.law == TranslationLaw::kPvsyst;
  Against against{elsewhere.name, pvsyst ? "PVsyst" : "De Soto", {}};
  against.result = Summarise(Predict(family, options, elsewhere.translation, shared, curves), set);
  return against;
}

// Cross-validation: leaves whole curves out in turn, refits the others from the joint optimum and
// tests on the curves left out. None if the observer stopped it.
std::optional<HeldOut> TestByFolds(const CurveSet& set, const FamilyProblem& family,
                                   const FamilyOptions& options, const JointProblem& problem,
                                   const JointEnd& end, const Observer& observer,
                                   std::vector<std::pair<int, Interval>>* power_W) {
  const std::vector<int>& fitted = family.curves.fitted;
  const int folds = std::min(options.folds, static_cast<int>(fitted.size()));
  std::vector<std::vector<Tested>> parts(folds);
  std::vector<std::vector<std::pair<int, Interval>>> powers(folds);
  const ProgressReporter progress(observer, "held out", folds);
  ParallelFor(folds, options.threads, [&](int f) {
    if (progress.Stopped()) return;
    std::vector<int> kept, left;
    for (std::size_t k = 0; k < fitted.size(); ++k) {
      (static_cast<int>(k) % folds == f ? left : kept).push_back(fitted[k]);
    }
    JointProblem rest = JointProblemOn(family, options, kept);
    rest.noise_A = problem.noise_A;
    const JointPoint start{end.point.shared, std::vector<JointLocal>(kept.size(), {0, 0})};
    JointOptions quick;
    quick.function_tolerance = 1e-10;
    quick.stop = progress.stop();
    const JointEnd refit = RefineJointly(rest, start, quick);
    parts[f] = Predict(family, options, family.translation, refit.point.shared, left);
    if (family.curves.key_points) {
      powers[f] = PredictPower(family, options, rest, refit, kept, left);
    }
    progress.Step();
  });
  if (progress.Stopped()) return {};
  std::vector<Tested> tested;
  for (const auto& part : parts) tested.insert(tested.end(), part.begin(), part.end());
  for (const auto& part : powers) power_W->insert(power_W->end(), part.begin(), part.end());
  HeldOut result = Summarise(tested, set);
  result.how = fmt::format("{} folds of whole curves", folds);
  return result;
}

// Median RMSE of the individual fits of the curves: the floor.
double IndividualMedian(const std::vector<FamilyCurve>& rows, const std::vector<int>& curves) {
  std::vector<double> rmse;
  for (const int c : curves) {
    const double one = rows[c].individual_rmse.solved_current_A;
    if (std::isfinite(one)) rmse.push_back(one);
  }
  return UpperMedian(std::move(rmse));
}

}  // namespace

Expected<void> CheckAgainst(const FamilyProblem& family, const FamilyOptions& options) {
  const int cells = family.translation.spec.cells_in_series;
  for (const NamedParameters& other : options.against) {
    const int found = other.translation.spec.cells_in_series;
    if (!other.cells_stated || found == cells) continue;
    return Fail(fmt::format("expected the cells_in_series of the set, {}, found {}", cells, found),
                other.name);
  }
  return {};
}

std::optional<FamilyTests> TestFamily(const PreparedFamily& prepared, const RefinedFamily& refined,
                                      const std::vector<FamilyCurve>& curves,
                                      const Observer& observer) {
  const CurveSet& set = prepared.set;
  const FamilyOptions& options = prepared.options;
  const FamilyProblem& family = refined.family;
  const FamilyMembers& members = family.curves;
  const std::vector<int>& tested = members.held_out.empty() ? members.fitted : members.held_out;
  const std::vector<double>& shared = refined.end.point.shared;
  FamilyTests tests;
  HeldOut held_out;
  if (!members.held_out.empty()) {
    held_out = TestOn(set, family, options, shared, tested);
    if (members.key_points) {
      tests.held_out_power_W =
          PredictPower(family, options, refined.problem, refined.end, members.fitted, tested);
    }
  } else if (options.folds > 0 && members.fitted.size() >= 4) {
    std::optional<HeldOut> folds = TestByFolds(set, family, options, refined.problem, refined.end,
                                               observer, &tests.held_out_power_W);
    if (!folds) return {};
    held_out = std::move(*folds);
  }
  if (held_out.curves > 0) {
    held_out.median_individual_rmse_A = IndividualMedian(curves, tested);
    tests.held_out = held_out;
  }
  for (const NamedParameters& other : options.against) {
    tests.against.push_back(TestAgainst(set, family, options, other, tested));
  }
  if (tests.against.empty() || tests.held_out) return tests;
  tests.in_sample = TestOn(set, family, options, shared, tested);
  tests.in_sample->how = "the curves that were fitted";
  tests.in_sample->median_individual_rmse_A = IndividualMedian(curves, tested);
  return tests;
}

}  // namespace lyrefit
