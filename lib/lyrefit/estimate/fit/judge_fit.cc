#include "lyrefit/estimate/fit/judge_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lyrefit/base/distributions.h"
#include "lyrefit/estimate/fit/estimate_parameters.h"
#include "lyrefit/estimate/fit/polish.h"
#include "lyrefit/estimate/fit/reading_errors.h"
#include "lyrefit/estimate/fit/statistics.h"

namespace lyrefit {
namespace {

constexpr double kRefutedAt = 0.05;

// Whether the bounds of a parameter are a choice that readings may refute: those of an ideality, and
// all that are not lyrefit's own.
bool AreAChoice(const PreparedFit& fit, int i) {
  const ParameterBounds& bounds = fit.bounds[i];
  if (fit.problem.fixed(i)) return false;
  if (fit.device.parameters[i].kind == ParameterKind::kIdeality) return true;
  const Device device = MakeDevice(fit.options.model, fit.curve.conditions, fit.options.constants);
  const auto own = MakeBounds({}, device, fit.curve);
  return own && ((*own)[i].lower != bounds.lower || (*own)[i].upper != bounds.upper);
}

// Indices of the diodes' parameters at a bound that can be widened. Below `steepest_n` a diode is a
// step in the current (model/term.h), and nothing is below 0, so these bounds are excluded.
std::vector<int> AtBound(const PreparedFit& fit, const RefineEnd& end) {
  const int diodes = DiodeCount(fit.device);
  std::vector<bool> absent(fit.device.size(), false);
  for (int d = 0; d < diodes; ++d) {
    absent[IdealityIndex(d)] = !(end.p[SaturationCurrentIndex(d)] > 0);
  }
  std::vector<int> found;
  for (int i = 0; i < 3 + 2 * diodes; ++i) {
    const double lower = fit.bounds[i].lower;
    const bool low = end.p[i] <= lower && lower > 0 && lower != fit.steepest_n;
    const bool at_bound = low || end.p[i] >= fit.bounds[i].upper;
    if (at_bound && !absent[i] && AreAChoice(fit, i)) found.push_back(i);
  }
  return found;
}

// Saturation currents and shunts span decades.
RefineProblem WithRoom(RefineProblem problem, const std::vector<int>& at_bound, double steepest) {
  for (const int i : at_bound) {
    const ParameterKind kind = problem.device.parameters[i].kind;
    const bool decades = kind == ParameterKind::kSaturation || kind == ParameterKind::kShunt;
    const double room = decades ? 1e6 : 4;
    problem.lower[i] /= room;
    if (kind == ParameterKind::kIdeality && steepest > 0) {
      problem.lower[i] = std::max(problem.lower[i], steepest);
    }
    problem.upper[i] *= room;
  }
  return problem;
}

// p-value of a decrease of the mean square from `bound` to `free` in one problem.
double PValue(const RefineProblem& problem, double bound, double free, int extra, int spare) {
  if (problem.errors == nullptr) return FTestPValue(bound, free, extra, spare);
  const double squares =
      (bound - free) * static_cast<double>(problem.voltage_V.size()) / std::pow(problem.noise_A, 2);
  return FisherTail(squares / extra, extra, spare);
}

// p-value with both ends refitted under the errors estimated from the wider fit; `p` if these show
// no correlated errors.
double UnderTheirErrors(const RefinedFit& refined, const RefineProblem& wide, const RefineEnd& free,
                        const RefineOptions& how, int extra, int spare, double p) {
  const PreparedFit& fit = refined.prepared;
  const std::optional<FoundErrors> found = FindErrors(wide, fit.fitted(), free, true);
  if (!found || found->gain <= kGainToBelieve) return p;
  const RefineProblem beyond =
      WeighByErrors(wide, fit.fitted(), {ErrorKind::kField, found->sizes, "field"}, free.p);
  RefineProblem within = beyond;
  within.lower = fit.problem.lower;
  within.upper = fit.problem.upper;
  const RefineEnd bound = Refine(within, refined.end.p, how);
  const double lowest =
      std::min(Refine(beyond, free.p, how).mean_square, Refine(beyond, bound.p, how).mean_square);
  return PValue(beyond, bound.mean_square, lowest, extra, spare);
}

}  // namespace

RefutedBounds FindRefutedBounds(const RefinedFit& refined, const ProgressReporter& progress) {
  if (progress.stop().requested()) return {};
  const PreparedFit& fit = refined.prepared;
  const RefineEnd& end = refined.end;
  const std::vector<int> at_bound = AtBound(fit, end);
  if (at_bound.empty()) return {};
  const RefineProblem wide = WithRoom(refined.problem, at_bound, fit.steepest_n);
  RefineOptions how;
  how.stop = progress.stop();
  RefineEnd free = Refine(wide, end.p, how);
  if (!free.converged) {  // it may creep
    RefineEnd other = RefineFrom(wide, end.p, how);
    if (other.mean_square < free.mean_square) free = std::move(other);
  }
  const int extra = static_cast<int>(at_bound.size());
  const int spare = fit.readings() - fit.free_parameters;
  double p = PValue(wide, end.mean_square, free.mean_square, extra, spare);
  if (p < kRefutedAt && refined.problem.errors == nullptr) {
    p = UnderTheirErrors(refined, wide, free, how, extra, spare, p);
  }
  if (!(p < kRefutedAt)) return {};
  RefutedBounds refuted;
  std::string where, room;
  for (const int i : at_bound) {
    const ParameterBounds& bounds = fit.bounds[i];
    const std::string& symbol = fit.device.parameters[i].symbol;
    const bool low = end.p[i] <= bounds.lower;
    where += fmt::format("{}{} = {:g}, its {} bound", where.empty() ? "" : ", ", symbol, end.p[i],
                         low ? "lower" : "upper");
    const std::pair<double, double> wider = {low ? wide.lower[i] : bounds.lower,
                                             low ? bounds.upper : wide.upper[i]};
    room += fmt::format("{}--bound {}={:g}:{:g}", room.empty() ? "" : " ", symbol, wider.first,
                        wider.second);
    refuted.wider[symbol] = wider;
  }
  refuted.test = fmt::format(
      "the readings refute {} (with more room the RMSE falls from {:.3g} to {:.3g} A, p = {:.1g})",
      where, std::sqrt(end.mean_square), std::sqrt(free.mean_square), p);
  refuted.because = fmt::format(
      "{}: the other parameters make up for it, and no interval would hold the truth; allow more "
      "with {}, or check temperature, number of cells and model",
      refuted.test, room);
  return refuted;
}

namespace {

std::string TooFewReadings(const PreparedFit& fit) {
  return fmt::format("{} different readings fix {} parameters without a remainder", fit.readings(),
                     fit.free_parameters);
}

bool IsSaturated(const PreparedFit& fit) { return fit.readings() <= fit.free_parameters; }

// Why there are no intervals; with wider bounds if those of the fit are refuted.
RefutedBounds WhyNoIntervals(const RefinedFit& refined, bool usable,
                             const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  if (fit.options.intervals == Intervals::kNone) return {};
  if (!usable) {
    return {
        "the fit is not usable: around parameters of a curve that the model does not describe "
        "no interval means anything",
        {},
        {}};
  }
  if (IsSaturated(fit)) {
    return {TooFewReadings(fit) + ", and nothing is left over to tell how well", {}, {}};
  }
  return FindRefutedBounds(refined, progress);
}

// Method of the intervals. With many correlated readings that are not averaged, profiles would take
// minutes.
Intervals MethodOf(const RefinedFit& refined) {
  constexpr std::size_t kMostProfiled = 2000;
  const Intervals wanted = refined.prepared.options.intervals;
  const bool many =
      refined.problem.errors != nullptr && refined.problem.voltage_V.size() > kMostProfiled;
  return many && wanted == Intervals::kProfile ? Intervals::kSymmetric : wanted;
}

JudgedFit WithIntervals(JudgedFit judged, const RefinedFit& refined,
                        const std::vector<double>& searched, const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  const Intervals method =
      judged.no_intervals_because.empty() ? MethodOf(refined) : Intervals::kNone;
  const auto ordered = [&](RefineEnd end) {
    OrderAlike(fit.device, fit.bounds, &end.p, &end.active);
    return end;
  };
  auto improved = ImproveByIntervals(
      ordered(refined.end), /*restarts=*/3,
      [&](const RefineEnd& end, bool final) {
        return FindIntervals(
            {refined.problem, end, fit.spare_readings()}, EstimatesOf(fit, searched, end.p),
            {method, refined.ends, refined.degrees, fit.options.threads, final}, progress);
      },
      [](const CurveIntervals& found) { return found.lower_optimum; },
      [&](const std::vector<double>& from) {
        RefineOptions how;
        how.stop = progress.stop();
        RefineEnd end = Refine(refined.problem, from, how);
        judged.restarts.push_back({"profile", std::sqrt(MeanSquare(refined.problem, from)),
                                   std::sqrt(end.mean_square), true});
        return ordered(std::move(end));
      });
  judged.end = std::move(improved.end);
  judged.estimates = std::move(improved.found.estimates);
  judged.correlations = std::move(improved.found.correlations);
  judged.covariance = std::move(improved.found.covariance);
  judged.condition = improved.found.condition;
  return judged;
}

double LargestRatio(const std::vector<double>& above, const std::vector<double>& below) {
  double largest = 0;
  for (std::size_t k = 0; k < above.size(); ++k) largest = std::max(largest, above[k] / below[k]);
  return largest;
}

// Estimates the errors of a least-squares fit, and finds intervals under them if they are believed
// (kGainToBelieve).
JudgedFit WithErrors(JudgedFit judged, const RefinedFit& refined,
                     const std::vector<double>& searched, const ProgressReporter& progress) {
  const PreparedFit& fit = refined.prepared;
  const bool possible = fit.options.loss == Loss::kSquared && judged.no_intervals_because.empty();
  const bool wanted = fit.options.find_errors && fit.options.intervals != Intervals::kNone;
  if (refined.errors || !wanted || !possible || progress.stop().requested()) return judged;
  const RefineEnd& end = judged.end;
  const std::optional<FoundErrors> found = FindErrors(fit.problem, fit.fitted(), end, false);
  if (!found) return judged;
  ErrorReport errors;
  errors.sizes = found->sizes;
  errors.gain = found->gain;
  errors.path_gain = found->path_gain;
  errors.current_stated = !fit.fitted().sigma_A.empty();
  errors.believed = found->gain > kGainToBelieve;
  const ErrorShape shape = ShapeOfErrors(fit.problem, fit.fitted(), end.p);
  errors.voltage_effect_A = found->sizes.voltage_V * LargestRatio(shape.voltage, shape.current);
  errors.part_effect_A = found->sizes.current_part * LargestRatio(shape.part, shape.current);
  judged.errors = errors;
  if (!errors.believed) return judged;
  const auto errors_at = [&](const ErrorSizes& sizes) {
    const ErrorModel model = MakeErrorModel(shape, sizes);
    return StandardErrors({fit.problem, end, fit.spare_readings(), &model});
  };
  const ErrorModel model = MakeErrorModel(shape, found->sizes);
  CurveIntervals under = FindIntervals(
      {fit.problem, end, fit.spare_readings(), &model}, EstimatesOf(fit, searched, end.p),
      {fit.options.intervals, refined.ends, FindDegrees(*found, errors_at, fit.spare_readings()),
       fit.options.threads,
       /*final=*/true},
      progress);
  judged.under_errors = std::move(under.estimates);
  judged.covariance = std::move(under.covariance);
  return judged;
}

}  // namespace

JudgedFit JudgeFit(const RefinedFit& refined, const std::vector<double>& searched, bool usable,
                   const ProgressReporter& progress) {
  JudgedFit judged;
  judged.errors = refined.errors;
  judged.refuted = WhyNoIntervals(refined, usable, progress);
  judged.no_intervals_because = judged.refuted.because;
  judged = WithIntervals(std::move(judged), refined, searched, progress);
  if (IsSaturated(refined.prepared)) {
    for (Estimate& e : judged.estimates) {
      if (e.fixed) continue;
      e.identifiable = false;
      e.reason = TooFewReadings(refined.prepared);
    }
  }
  return WithErrors(std::move(judged), refined, searched, progress);
}

}  // namespace lyrefit
