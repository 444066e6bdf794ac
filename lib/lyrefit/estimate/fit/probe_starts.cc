#include "lyrefit/estimate/fit/descents.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <set>

#include "lyrefit/base/dense.h"
#include "lyrefit/estimate/refine/coordinates.h"
#include "lyrefit/estimate/refine/separable.h"
#include "lyrefit/model/device_effects.h"
#include "lyrefit/model/kernel.h"
#include "lyrefit/model/model_points.h"

namespace lyrefit {
namespace {

constexpr std::size_t kFewSettings = 8;

struct Trial {
  std::vector<double> p;
  std::vector<double> setting;  // values of the enumerated parameters of effects
  double left = HUGE_VAL;       // remaining sum of squares, by linear approximation
};

RefineProblem BaseAlone(const RefineProblem& problem) {
  Device base = problem.device;
  base.effects = nullptr;
  const int size = problem.device.effects->law.base_size();
  base.parameters.resize(size);
  return MakeRefineProblem(
      base, problem.objective, problem.voltage_V, problem.current_A, problem.weights,
      std::vector<double>(problem.lower.begin(), problem.lower.begin() + size),
      std::vector<double>(problem.upper.begin(), problem.upper.begin() + size));
}

// Residuals that a fitted device cannot explain.
class Unexplained {
 public:
  // Residuals of `problem` at `without`, minus their projection on the parameters of `fitted` at
  // `end` that are free to move.
  Unexplained(const RefineProblem& problem, const RefineProblem& fitted, const FitPoint& end,
              const std::vector<bool>& active, const std::vector<double>& without)
      : problem_(problem),
        explained_(RankedBasis(Linearize(CurveModel(fitted), end, active).jacobian)) {
    residual_ = Of(without);
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
  Eigen::VectorXd residual_;  // at `without`
};

// Whether the effect is about proportional to its strength. Shading is not: its knee moves.
bool ActsInProportion(const Effect& effect) {
  if (effect.parameters.front().neutral != 0) return false;
  return std::none_of(effect.parameters.begin(), effect.parameters.end(),
                      [&](const EffectParameter& p) { return p.searched && effect.cell; });
}

// Remaining sum of squares with a probe, at the strength that fits the residuals best.
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

// Tries all probes of one effect, with the other effects as in `p`. Without `unexplained`, probes
// are ranked by the mean square of the whole problem.
void TryProbes(const RefineProblem& problem, const Variant& variant, const Unexplained* unexplained,
               const std::vector<double>& p, std::size_t use, std::vector<Trial>* trials) {
  const DeviceEffects& device_effects = *problem.device.effects;
  const Effect& effect = *device_effects.uses[use].effect;
  const int first = device_effects.law.Offset(static_cast<int>(use));
  const ParameterBounds* const bounds = &variant.bounds[first - device_effects.law.base_size()];
  std::vector<Probe> probes = {{}};  // at the usual values
  if (effect.probes != nullptr) probes = effect.probes(device_effects.readings.traits);
  for (const Probe& probe : probes) {
    Trial trial{p, {static_cast<double>(use)}, HUGE_VAL};
    for (std::size_t k = 0; k < probe.size(); ++k) {
      double& own = trial.p[first + k];
      own = WithinBounds(bounds[k], probe[k]);
      if (effect.parameters[k].searched) trial.setting.push_back(own);
    }
    if (unexplained != nullptr) {
      AskStrength(*unexplained, effect, *bounds, first, &trial);
    } else {
      trial.left = MeanSquare(problem, trial.p);
    }
    if (std::isfinite(trial.left)) trials->push_back(std::move(trial));
  }
}

void BestFirst(std::vector<Trial>* trials) {
  std::stable_sort(trials->begin(), trials->end(),
                   [](const Trial& a, const Trial& b) { return a.left < b.left; });
}

// Tries all probes of all effects at a base device, one effect at a time, with the others at their
// usual values.
std::vector<Trial> TryAllProbes(const RefineProblem& problem, const Variant& variant,
                                const Unexplained* unexplained, const std::vector<double>& p) {
  std::vector<Trial> trials;
  for (std::size_t use = 0; use < problem.device.effects->uses.size(); ++use) {
    TryProbes(problem, variant, unexplained, p, use, &trials);
  }
  BestFirst(&trials);
  return trials;
}

// Keeps the best `count` trials. If there are few settings, the best of each setting comes first
// and all settings are kept.
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

std::vector<std::vector<double>> PlacesOf(std::vector<Trial> trials) {
  std::vector<std::vector<double>> places;
  places.reserve(trials.size());
  for (Trial& trial : trials) places.push_back(std::move(trial.p));
  return places;
}

}  // namespace

std::vector<double> TypicalDevice(const RefineProblem& problem, const std::vector<double>& place) {
  const DeviceEffects* const device_effects = problem.device.effects.get();
  const double current = *std::max_element(problem.current_A.begin(), problem.current_A.end());
  double voltage = problem.voltage_scale_V;
  if (device_effects != nullptr) {
    const DataTraits& traits = device_effects->readings.traits;
    const double per_cell = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
    voltage = per_cell * device_effects->readings.scale.cells;
  }
  constexpr double kIdeality = 1.2;
  std::vector<double> p(device_effects != nullptr ? device_effects->law.base_size()
                                                  : problem.device.size());
  p[kIph] = current;
  p[kRs] = 0.02 * voltage / current;
  p[kRsh] = 100 * voltage / current;
  p[SaturationCurrentIndex(0)] =
      SaturationCurrent(current, voltage, kIdeality * problem.device.module_thermal_voltage_V);
  for (int d = 0; d < DiodeCount(problem.device); ++d) p[IdealityIndex(d)] = kIdeality;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p[i] = std::min(std::max(p[i], problem.lower[i]), problem.upper[i]);
  }
  p.insert(p.end(), place.begin(), place.end());
  return p;
}

std::vector<std::vector<double>> ProbeStarts(const RefineProblem& problem, const Variant& variant,
                                             std::size_t count) {
  const DeviceEffects& device_effects = *problem.device.effects;
  const RefineProblem alone = BaseAlone(problem);
  const RefineEnd base = RefineFrom(alone, SeparableStarts(alone, 0, 1).at(0).p);
  std::vector<double> usual = base.p;
  usual.insert(usual.end(), variant.usual.begin(), variant.usual.end());
  const Unexplained unexplained(problem, alone, base, base.active, usual);
  std::vector<Trial> trials = TryAllProbes(problem, variant, &unexplained, usual);
  KeepBest(count, &trials);
  const bool unlike = std::any_of(device_effects.uses.begin(), device_effects.uses.end(),
                                  [](const EffectUse& use) { return use.effect->groups; });
  if (unlike) {
    std::vector<Trial> typical =
        TryAllProbes(problem, variant, nullptr, TypicalDevice(problem, variant.usual));
    KeepBest(count / 2, &typical);
    trials.insert(trials.end(), typical.begin(), typical.end());
  }
  return PlacesOf(std::move(trials));
}

std::vector<std::vector<double>> ProbesBeside(const RefineProblem& problem, const Variant& variant,
                                              const RefineEnd& fitted,
                                              const std::vector<bool>& others, std::size_t count) {
  const DeviceEffects& device_effects = *problem.device.effects;
  const RefineProblem own = InVariant(problem, variant, fitted.p);
  std::vector<double> without = fitted.p;
  std::vector<bool> active = fitted.active;
  for (std::size_t use = 0; use < others.size(); ++use) {
    const Effect& effect = *device_effects.uses[use].effect;
    const int first = device_effects.law.Offset(static_cast<int>(use));
    if (!others[use]) continue;
    for (int k = 0; k < effect.size(); ++k) active[first + k] = true;
    without[first] = effect.parameters.front().neutral;
  }
  const Unexplained unexplained(problem, own, fitted, active, without);
  std::vector<Trial> trials;
  for (std::size_t use = 0; use < others.size(); ++use) {
    if (others[use]) TryProbes(problem, variant, &unexplained, without, use, &trials);
  }
  BestFirst(&trials);
  KeepBest(count, &trials);
  return PlacesOf(std::move(trials));
}

}  // namespace lyrefit
