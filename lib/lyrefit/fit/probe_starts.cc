#include "lyrefit/fit/probe_starts.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/base/dense.h"
#include "lyrefit/law/extension.h"
#include "lyrefit/law/kernel.h"
#include "lyrefit/refine/curve_model.h"
#include "lyrefit/refine/linearize.h"
#include "lyrefit/refine/refine.h"
#include "lyrefit/refine/separable.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewSettings = 8;

struct Trial {
  std::vector<double> p;
  std::vector<double> setting;  // of the effects' parameters that do not descend
  double left = HUGE_VAL;       // of the squared residuals, as far as straight lines tell
};

RefineProblem BaseAlone(const RefineProblem& problem) {
  Device base = problem.device;
  base.extension = nullptr;
  const int size = problem.device.extension->law.base_size();
  base.parameters.resize(size);
  return MakeRefineProblem(
      base, problem.objective, problem.voltage_V, problem.current_A, problem.weights,
      std::vector<double>(problem.lower.begin(), problem.lower.begin() + size),
      std::vector<double>(problem.upper.begin(), problem.upper.begin() + size));
}

// What of the residuals the polished base device cannot take over.
class Unexplained {
 public:
  Unexplained(const RefineProblem& problem, const RefineProblem& alone, const RefineEnd& base)
      : problem_(problem),
        explained_(RankedBasis(Linearize(CurveModel(alone), base, base.held).jacobian)) {
    std::vector<double> usual = base.p;
    const std::vector<double>& own = problem.device.extension->usual;
    usual.insert(usual.end(), own.begin(), own.end());
    residual_ = Of(usual);
  }

  const Eigen::VectorXd& residual() const { return residual_; }

  Eigen::VectorXd Of(const std::vector<double>& p) const {
    const std::vector<double> currents =
        SolveCurrents(problem_.device, p.data(), problem_.points, *problem_.kernel);
    Eigen::VectorXd residual(currents.size());
    for (std::size_t k = 0; k < currents.size(); ++k) {
      residual[k] = (problem_.current_A[k] - currents[k]) * std::sqrt(problem_.weights[k]);
    }
    TakeOut(explained_, &residual);
    return residual;
  }

 private:
  const RefineProblem& problem_;
  Eigen::MatrixXd explained_;
  Eigen::VectorXd residual_;  // of the base device with the effects as usual
};

// Whether the effect acts about in proportion to its strength: a shade moves its knee instead.
bool ActsInProportion(const Effect& effect) {
  if (effect.parameters.front().neutral != 0) return false;
  return std::none_of(effect.parameters.begin(), effect.parameters.end(),
                      [&](const EffectParameter& p) { return p.searched && effect.cell; });
}

// What a probe would leave of the residuals, at the strength they ask for.
void AskStrength(const Unexplained& unexplained, const Effect& effect,
                 const ParameterBounds& strength, int first, Trial* trial) {
  const Eigen::VectorXd& residual = unexplained.residual();
  const Eigen::VectorXd added = residual - unexplained.Of(trial->p);
  trial->left = (residual - added).squaredNorm();
  if (!(added.squaredNorm() > 0) || !ActsInProportion(effect)) return;
  const double probed = trial->p[first];
  double asked = probed * added.dot(residual) / added.squaredNorm();
  if (strength.lower >= 0) asked = std::max(asked, 1e-3 * std::fabs(probed));
  asked = std::min(std::max(asked, 0.9 * strength.lower), 0.9 * strength.upper);
  const double left = (residual - asked / probed * added).squaredNorm();
  if (!(left < trial->left)) return;
  trial->p[first] = asked;
  trial->left = left;
}

// All probes of all effects at a base device, one effect at a time, the others at what is usual.
// What they leave is counted as it stands where nothing is said to be explained.
std::vector<Trial> TryProbes(const RefineProblem& problem, const Unexplained* unexplained,
                             const std::vector<double>& base) {
  const Extension& extension = *problem.device.extension;
  std::vector<Trial> trials;
  for (std::size_t e = 0; e < extension.uses.size(); ++e) {
    const Effect& effect = *extension.uses[e].effect;
    const int first = extension.law.Offset(static_cast<int>(e));
    const ParameterBounds* const bounds = &extension.bounds[first - extension.law.base_size()];
    std::vector<Probe> probes = {{}};  // as usual
    if (effect.probes != nullptr) probes = effect.probes(extension.readings.traits);
    for (const Probe& probe : probes) {
      Trial trial{base, {static_cast<double>(e)}, HUGE_VAL};
      trial.p.insert(trial.p.end(), extension.usual.begin(), extension.usual.end());
      for (std::size_t k = 0; k < probe.size(); ++k) {
        double& own = trial.p[first + k];
        own = std::min(std::max(probe[k], bounds[k].lower), bounds[k].upper);
        if (effect.parameters[k].searched) trial.setting.push_back(own);
      }
      if (unexplained != nullptr) {
        AskStrength(*unexplained, effect, *bounds, first, &trial);
      } else {
        trial.left = MeanSquare(problem, trial.p);
      }
      if (std::isfinite(trial.left)) trials.push_back(std::move(trial));
    }
  }
  std::stable_sort(trials.begin(), trials.end(),
                   [](const Trial& a, const Trial& b) { return a.left < b.left; });
  return trials;
}

// A crystalline device with the largest current and the open-circuit voltage of the readings: where
// cells stand under unlike light, no base device by itself is like the one behind the curve.
std::vector<double> TypicalBase(const RefineProblem& problem) {
  const Extension& extension = *problem.device.extension;
  const DataTraits& traits = extension.readings.traits;
  const double current = *std::max_element(problem.current_A.begin(), problem.current_A.end());
  const double per_cell = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
  const double voltage = per_cell * extension.readings.scale.cells;
  constexpr double kIdeality = 1.2;
  std::vector<double> p(extension.law.base_size(), 0);
  p[kIph] = current;
  p[kRs] = 0.02 * voltage / current;
  p[kRsh] = 100 * voltage / current;
  p[SaturationCurrentIndex(0)] =
      current / std::expm1(voltage / (kIdeality * problem.device.module_thermal_voltage_V));
  for (int d = 0; d < DiodeCount(problem.device); ++d) p[IdealityIndex(d)] = kIdeality;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] = std::min(std::max(p[i], problem.lower[i]), problem.upper[i]);
  }
  return p;
}

// The first of each setting where these are few, then the others, so many in all.
void KeepBest(std::size_t count, std::vector<Trial>* trials) {
  std::set<std::vector<double>> settings;
  for (const Trial& trial : *trials) settings.insert(trial.setting);
  if (settings.size() <= kFewSettings) {
    count = std::max(count, settings.size());
    settings.clear();
    std::stable_partition(trials->begin(), trials->end(), [&](const Trial& trial) {
      return settings.insert(trial.setting).second;
    });
  }
  trials->resize(std::min(count, trials->size()));
}

}  // namespace

std::vector<std::vector<double>> ProbeStarts(const RefineProblem& problem, std::size_t count) {
  const Extension& extension = *problem.device.extension;
  const RefineProblem alone = BaseAlone(problem);
  const RefineEnd base = RefineFrom(alone, SeparableStarts(alone, 0, 1).at(0).p);
  const Unexplained unexplained(problem, alone, base);
  std::vector<Trial> trials = TryProbes(problem, &unexplained, base.p);
  KeepBest(count, &trials);
  const bool unlike = std::any_of(extension.uses.begin(), extension.uses.end(),
                                  [](const EffectUse& use) { return use.effect->groups; });
  if (unlike) {
    std::vector<Trial> typical = TryProbes(problem, nullptr, TypicalBase(problem));
    KeepBest(count / 2, &typical);
    trials.insert(trials.end(), typical.begin(), typical.end());
  }
  std::vector<std::vector<double>> starts;
  starts.reserve(trials.size());
  for (Trial& trial : trials) starts.push_back(std::move(trial.p));
  return starts;
}

}  // namespace lyrefit
