#include "lyrefit/family/family_weights.h"

#include <cmath>
#include <utility>
#include <vector>

#include "lyrefit/base/observer.h"
#include "lyrefit/estimate/fit/statistics.h"
#include "lyrefit/family/family_members.h"
#include "lyrefit/family/joint_fit.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
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
