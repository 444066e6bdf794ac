#include "lyrefit/family/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lyrefit/base/seconds.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/estimate/refine/multistart.h"
#include "lyrefit/family/family_judge.h"
#include "lyrefit/family/family_members.h"
#include "lyrefit/model/kernel.h"

namespace lyrefit {
namespace {

// `value`: sum of squares of the points and of the priors.
struct JointDescent : MultistartEnd {
  JointEnd end;
};

bool HasPriors(const JointProblem& problem) {
  return std::any_of(problem.curves.begin(), problem.curves.end(), [](const JointCurve& curve) {
    return (curve.irradiance_sd > 0 && std::isfinite(curve.irradiance_sd)) ||
           (curve.temperature_sd_K > 0 && std::isfinite(curve.temperature_sd_K));
  });
}

// Estimates the noise of a point of weight 1 from the residuals of a fit.
double NoiseOf(const FamilyProblem& family, const JointProblem& problem, const JointEnd& end) {
  const JointSpread spread = FindJointSpread(problem, end, problem.noise_A * problem.noise_A);
  const double degrees = JointDegrees(problem, family.free_parameters, spread.local_degrees);
  return std::sqrt(end.squares / degrees);
}

// The problem with its integer-valued parameters fixed at the values of `shared`.
JointProblem WithIntegersFixed(JointProblem problem, const FamilyProblem& family,
                               const std::vector<double>& shared) {
  for (std::size_t i = 0; i < family.bounds.size(); ++i) {
    if (family.bounds[i].whole == 0) continue;
    problem.lower[i] = problem.upper[i] = WithinBounds(family.bounds[i], shared[i]);
  }
  return problem;
}

}  // namespace

JointEnd FitJointly(const FamilyProblem& family, const FamilyOptions& options,
                    const std::vector<int>& search_curves, const std::vector<JointPoint>& starts,
                    const Observer& observer, JointProblem* problem) {
  const ProgressReporter progress(observer, "joint fit", 0);
  JointOptions thorough;
  thorough.stop = progress.stop();
  JointProblem small = JointProblemOn(family, options, search_curves);
  // Priors count from the start. The first guess of the noise is 0.1 % of the current scale.
  small.noise_A = problem->noise_A = 1e-3 * problem->current_scale_A;
  enum { kSearchCurves, kAllCurves };
  const auto refine = [&](const MultistartStage& stage, JointDescent* at) {
    const bool quick = stage.problem == kSearchCurves;
    const JointProblem& on = quick ? small : *problem;
    JointPoint start = at->end.point;
    start.local.assign(on.curves.size(), {0, 0});
    JointOptions how = thorough;
    if (quick) how.function_tolerance = 1e-10;
    at->end = RefineJointly(WithIntegersFixed(on, family, start.shared), start, how);
    at->value = at->end.squares + at->end.prior_squares;
  };
  MultistartRules rules;
  rules.stages = {{0, 2, kSearchCurves}};
  rules.last.problem = kAllCurves;
  rules.apart = 1e-6;
  rules.threads = options.threads;
  std::vector<JointDescent> from(starts.size());
  for (std::size_t s = 0; s < starts.size(); ++s) from[s].end.point = starts[s];
  Multistart<JointDescent> run;
  RunMultistart(rules, std::move(from), refine, NeverSame, &run);
  JointEnd best = run.Best().end;
  *problem = WithIntegersFixed(std::move(*problem), family, best.point.shared);
  SettleNoise(family, thorough, problem, &best);
  best.stopped = progress.Stopped();
  return best;
}

void SettleNoise(const FamilyProblem& family, const JointOptions& how, JointProblem* problem,
                 JointEnd* end) {
  constexpr int kRounds = 4;
  if (!HasPriors(*problem)) return;
  for (int round = 0; round < kRounds && !how.stop.Stopped(); ++round) {
    const double before = problem->noise_A;
    problem->noise_A = std::max(NoiseOf(family, *problem, *end), 1e-9 * problem->current_scale_A);
    *end = RefineJointly(*problem, end->point, how);
    if (std::fabs(problem->noise_A / before - 1) < 1e-3) break;
  }
}

CandidateEnds PolishCandidate(const FamilyProblem& family, const FamilyOptions& options,
                              const std::vector<int>& search_curves, const JointPoint& candidate,
                              const Observer& observer, JointProblem problem) {
  CandidateEnds ends;
  JointPoint start = candidate;
  start.local.assign(problem.curves.size(), {0, 0});
  const ProgressReporter progress(observer, "joint fit", 0);
  JointOptions how;
  how.stop = progress.stop();
  Instant begin = Now();
  ends.plain = RefineJointlyPlainly(problem, start, how);
  ends.plain_seconds = SecondsSince(begin);
  begin = Now();
  ends.own = FitJointly(family, options, search_curves, {candidate}, observer, &problem);
  ends.own_seconds = SecondsSince(begin);
  return ends;
}

std::vector<double> StartFromIndividualFit(const FamilyProblem& family, const JointCurve& curve,
                                           const std::vector<double>& individual_parameters) {
  const Translation& at = family.translation;
  std::vector<double> shared(at.size() + 2, 0);
  for (int i = 0; i < at.size() + 2; ++i) {
    const ParameterBounds& b = family.bounds[i];
    shared[i] =
        std::isnan(family.fixed[i]) ? 0.5 * (b.search_lower + b.search_upper) : family.fixed[i];
  }
  if (at.extended) {
    const std::vector<double>& usual = at.extended->effects->usual;
    std::copy(usual.begin(), usual.end(), shared.end() - 2 - static_cast<int>(usual.size()));
  }
  const auto set = [&](int i, double value) {
    if (i >= 0 && std::isnan(family.fixed[i])) shared[i] = value;
  };
  const double g = curve.irradiance_W_m2 / kReferenceIrradiance_W_m2;
  set(at.bandgap, 1.121);
  set(at.alpha_sc, 5e-4 * family.curves.reference_current_A);
  set(at.n_slope, 0);
  set(at.n, individual_parameters[IdealityIndex(0)]);
  const double dt = curve.temperature_K - kReferenceTemperature_K;
  set(at.photocurrent, individual_parameters[kIph] / g - shared[at.alpha_sc] * dt);
  set(at.resistance_series, individual_parameters[kRs]);
  const double resistance = family.bounds[at.resistance_series].upper;
  const double shunt = std::min(individual_parameters[kRsh], 1e5 * resistance);
  set(at.resistance_shunt, at.spec.shunt == ShuntLaw::kConstant ? shunt : shunt * g);
  if (at.resistance_shunt_dark >= 0) set(at.resistance_shunt_dark, 4 * shared[at.resistance_shunt]);
  if (at.recombination >= 0) set(at.recombination, 0);
  // Io_ref follows from this curve's saturation current and the factor by which the law changes it.
  shared[at.saturation_current] = 1;
  if (at.n_2 >= 0) shared[at.saturation_current_2] = 0;
  std::vector<double> device(at.device.size());
  Translate(at, shared.data(), curve.irradiance_W_m2, curve.temperature_K, device.data());
  const double factor = device[SaturationCurrentIndex(0)];
  const double saturation = individual_parameters[SaturationCurrentIndex(0)];
  if (!(factor > 0) || !(saturation > 0) || !std::isfinite(factor)) return {};
  set(at.saturation_current, saturation / factor);
  if (!std::isnan(family.fixed[at.saturation_current])) {
    shared[at.saturation_current] = family.fixed[at.saturation_current];
  }
  if (at.saturation_current_2 >= 0) {
    const ParameterBounds& range = family.bounds[at.saturation_current_2];
    set(at.saturation_current_2, std::sqrt(range.search_lower * range.search_upper));
  }
  return shared;
}

namespace {

constexpr double kExact = 1e-11;  // relative to the currents: rounding errors only

// ln L at the most likely noise level, up to a constant.
double LogLikelihoodOf(const JointProblem& problem, const JointEnd& end) {
  double count = 0, weights = 0;
  for (const JointCurve& curve : problem.curves) {
    count += static_cast<double>(curve.weight.size());
    for (const double weight : curve.weight) weights += std::log(weight);
  }
  return 0.5 * (weights - count * std::log(end.squares / count));
}

// Whether the residuals are noise and not a misfit of the law: their variance is at most kMost
// times the variance that differences of neighbouring residuals imply. For white noise the ratio is
// 1.
bool IsNoise(const JointProblem& problem, const JointEnd& end) {
  constexpr double kMost = 2;
  double squares = 0, noise = 0;
  for (int c = 0; c < static_cast<int>(problem.curves.size()); ++c) {
    const JointCurve& curve = problem.curves[c];
    std::vector<double> residual =
        SolveCurrents(DeviceOf(problem, c), DeviceAt(problem, end.point, c).data(),
                      MakePointSet(curve.voltage_V, curve.current_A));
    for (std::size_t k = 0; k < residual.size(); ++k) {
      residual[k] = std::sqrt(curve.weight[k]) * (residual[k] - curve.current_A[k]);
      squares += residual[k] * residual[k];
    }
    const double differences = NoiseFromDifferences(curve.voltage_V, residual);
    noise += static_cast<double>(residual.size()) * differences * differences;
  }
  return squares <= kMost * noise;
}

double Rms(const JointProblem& problem, const JointEnd& end) {
  double count = 0;
  for (const JointCurve& curve : problem.curves) count += static_cast<double>(curve.weight.size());
  return std::sqrt(end.squares / count);
}

}  // namespace

WeightChoice SettleWeights(const FamilyOptions& options, const Observer& observer,
                           FamilyProblem* family, JointProblem* problem, JointEnd* end) {
  WeightChoice choice;
  if (options.weights != FamilyWeights::kAuto || family->curves.key_points) {
    choice.used = options.weights;
    return choice;
  }
  const FamilyMembers& members = family->curves;
  if (members.stated_errors || end->stopped) return choice;
  if (!(Rms(*problem, *end) > kExact * problem->current_scale_A)) return choice;
  FamilyMembers weighed = family->curves;
  WeighMembers(FamilyWeights::kIsc, &weighed);
  JointProblem relative = *problem;
  for (std::size_t k = 0; k < relative.curves.size(); ++k) {
    relative.curves[k].weight = weighed.members[weighed.fitted[k]].joint.weight;
  }
  const ProgressReporter progress(observer, "joint fit", 0);
  JointOptions how;
  how.stop = progress.stop();
  JointEnd there = RefineJointly(relative, end->point, how);
  SettleNoise(*family, how, &relative, &there);
  if (progress.Stopped()) {
    end->stopped = true;
    return choice;
  }
  choice.gain = kUnknown;
  if (!IsNoise(*problem, *end) && !IsNoise(relative, there)) return choice;
  choice.gain = 2 * (LogLikelihoodOf(relative, there) - LogLikelihoodOf(*problem, *end));
  if (!(*choice.gain > 0)) return choice;
  choice.used = FamilyWeights::kIsc;
  family->curves = std::move(weighed);
  *problem = std::move(relative);
  *end = std::move(there);
  return choice;
}

}  // namespace lyrefit
