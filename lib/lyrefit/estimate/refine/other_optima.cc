#include "lyrefit/estimate/refine/other_optima.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace lyrefit {
namespace {

constexpr std::size_t kMostSettings = 6;  // of an effect; those of the lowest error are refitted
constexpr double kSameCurve = 1e-3;       // of the error, below which two optima have one curve
constexpr double kSameNumber = 1e-3;      // relative, below which the effects have the same numbers

// Settings of one effect and their trial values.
struct Settings {
  std::vector<int> parameters;
  std::set<std::vector<double>> values;  // one value for each parameter
};

// Settings of every effect that has some.
std::vector<Settings> FindSettings(const EffectSpan& effects) {
  const DeviceEffects& device_effects = *effects.effects;
  int first = effects.first;
  std::vector<Settings> all;
  auto bounds = device_effects.bounds.begin();
  for (const EffectUse& use : device_effects.uses) {
    const Effect& effect = *use.effect;
    std::vector<int> searched;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].searched && bounds[k].lower < bounds[k].upper) searched.push_back(k);
    }
    if (!searched.empty() && effect.probes != nullptr) {
      Settings settings;
      settings.parameters.reserve(searched.size());
      for (const int k : searched) settings.parameters.push_back(first + k);
      for (const Probe& probe : effect.probes(device_effects.readings.traits)) {
        std::vector<double> values;
        values.reserve(searched.size());
        for (const int k : searched) {
          values.push_back(std::min(std::max(probe[k], bounds[k].lower), bounds[k].upper));
        }
        settings.values.insert(std::move(values));
      }
      all.push_back(std::move(settings));
    }
    first += effect.size();
    bounds += effect.size();
  }
  return all;
}

std::vector<double> Residuals(const FitModel& model, const FitPoint& at) {
  std::vector<double> all;
  const double* local = at.local.data();
  for (std::size_t b = 0; b < model.shape().blocks.size(); ++b) {
    const FitBlock& block = model.shape().blocks[b];
    std::vector<double> own(block.residuals);
    model.Evaluate(static_cast<int>(b), at.p.data(), local, own.data(), nullptr, nullptr);
    all.insert(all.end(), own.begin(), own.end());
    local += block.locals;
  }
  return all;
}

bool SameCurve(const std::vector<double>& a, const std::vector<double>& b) {
  double apart = 0, size = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    apart += (a[k] - b[k]) * (a[k] - b[k]);
    size += a[k] * a[k];
  }
  return !(apart > kSameCurve * kSameCurve * size);
}

struct Optimum {
  FitPoint at;
  std::vector<double> residuals;
};

// Whether two optima are equal; a different setting alone does not distinguish them.
bool Same(const Optimum& a, const Optimum& b, const std::vector<int>& numbers) {
  return SameCurve(a.residuals, b.residuals) &&
         std::all_of(numbers.begin(), numbers.end(), [&](int i) {
           const double x = a.at.p[i], y = b.at.p[i];
           return std::fabs(x - y) <= kSameNumber * std::max(std::fabs(x), std::fabs(y));
         });
}

// Indices of the effects' parameters that are not settings.
std::vector<int> Numbers(const EffectSpan& effects) {
  std::vector<int> numbers;
  int first = effects.first;
  for (const EffectUse& use : effects.effects->uses) {
    for (const EffectParameter& info : use.effect->parameters) {
      if (!info.searched) numbers.push_back(first);
      ++first;
    }
  }
  return numbers;
}

// Points of the lowest error among those from `best` with other settings.
std::vector<FitPoint> WithOthers(const FitModel& model, const Settings& settings,
                                 const FitPoint& best) {
  std::vector<std::pair<double, FitPoint>> trials;
  for (const std::vector<double>& values : settings.values) {
    FitPoint other = best;
    for (std::size_t k = 0; k < values.size(); ++k) other.p[settings.parameters[k]] = values[k];
    const double mean_square = model.MeanSquare(other);
    if (std::isfinite(mean_square)) trials.emplace_back(mean_square, std::move(other));
  }
  std::stable_sort(trials.begin(), trials.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (trials.size() > kMostSettings) trials.resize(kMostSettings);
  std::vector<FitPoint> points;
  points.reserve(trials.size());
  for (auto& trial : trials) points.push_back(std::move(trial.second));
  return points;
}

}  // namespace

std::vector<bool> FindFlatSettings(const FitModel& model, const EffectSpan& effects,
                                   const FitPoint& at) {
  const int count = model.shape().size();
  std::vector<bool> flat(count, false);
  if (effects.effects == nullptr) return flat;
  std::vector<bool> seen(count, false);
  const double* local = at.local.data();
  for (std::size_t b = 0; b < model.shape().blocks.size(); ++b) {
    const FitBlock& block = model.shape().blocks[b];
    std::vector<double> residuals(block.residuals);
    std::vector<double> slopes(static_cast<std::size_t>(block.residuals) * count);
    if (!model.Evaluate(static_cast<int>(b), at.p.data(), local, residuals.data(), slopes.data(),
                        nullptr)) {
      return flat;
    }
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      if (slopes[k] != 0) seen[k % count] = true;
    }
    local += block.locals;
  }
  for (const Settings& settings : FindSettings(effects)) {
    for (const int k : settings.parameters) flat[k] = !seen[k];
  }
  return flat;
}

std::vector<FitPoint> FindOtherOptima(const FitModel& model, const EffectSpan& effects,
                                      const FitPoint& best, std::vector<FitPoint> ends,
                                      const OptimumQuery& query) {
  for (const Settings& settings : FindSettings(effects)) {
    for (FitPoint& other : WithOthers(model, settings, best)) {
      ends.push_back(RefineModel(model, std::move(other), query.how));
    }
  }
  const std::vector<int> numbers = Numbers(effects);
  std::vector<Optimum> optima = {{best, Residuals(model, best)}};
  for (FitPoint& end : ends) {
    if (!(model.MeanSquare(end) < query.highest)) continue;
    Optimum other{end, Residuals(model, end)};
    if (std::any_of(optima.begin(), optima.end(),
                    [&](const Optimum& known) { return Same(other, known, numbers); })) {
      continue;
    }
    optima.push_back(std::move(other));
  }
  std::vector<FitPoint> local_optima;
  local_optima.reserve(optima.size());
  for (std::size_t k = 1; k < optima.size(); ++k) local_optima.push_back(std::move(optima[k].at));
  return local_optima;
}

}  // namespace lyrefit
