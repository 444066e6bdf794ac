#include "lyrefit/estimate/fit/descents.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/model/law.h"

namespace lyrefit {
namespace {

MultistartRules DescentRules(int threads, const ProgressReporter& progress) {
  constexpr int kOfEachVariant = 2;  // descents of a variant that always continue
  constexpr double kClose = 1.02;    // of the lowest RMSE: ends below it are run to convergence
  constexpr double kNear = 3;        // of the lowest RMSE: descents above it are stopped
  MultistartRules rules;
  rules.stages = {{5, 12, 0, kOfEachVariant, true},
                  {9, 6, 0, kOfEachVariant, true},
                  {20, 6, 0, kOfEachVariant, false},
                  {100, 6, 0, kOfEachVariant, false}};
  rules.hopeless = kNear * kNear;
  rules.close = kClose * kClose;
  rules.visits = 3;
  rules.threads = threads;
  rules.progress = progress;
  return rules;
}

// Ends are compared across variants, since a variant that is a special case of another one can
// reach its curve.
bool SameOptimum(const DescentEnd& a, const DescentEnd& b) {
  constexpr double kSameOptimum = 1e-6;  // relative, of the mean square
  return std::fabs(a.end.mean_square - b.end.mean_square) <= kSameOptimum * b.end.mean_square;
}

// Stores the new end of a descent unless it was lower before.
void Take(const RefineProblem& problem, const Variant& variant, RefineEnd end, DescentEnd* at) {
  const double factor = VariantPenalty(problem, variant);
  const double penalised = end.mean_square * factor * factor;
  constexpr double kSame = 1e-12;  // relative: rounding of repeated evaluations
  if (!at->end.p.empty() && !(penalised <= at->value * (1 + kSame))) return;
  at->end = std::move(end);
  at->value = std::isfinite(penalised) ? penalised : HUGE_VAL;
}

DescentEnd StartOf(const PreparedFit& fit, PolishStart start) {
  RefineEnd here;
  here.p = start.p;
  LawWorkspace evaluation_limit(GiveUp::kSlow);
  here.mean_square = MeanSquare(fit.problem, start.p, &evaluation_limit);
  here.active.assign(start.p.size(), false);
  DescentEnd at;
  at.group = start.variant;
  at.start = std::move(start);
  Take(fit.problem, fit.variants[at.group], std::move(here), &at);
  return at;
}

RefineOptions Briefly(int steps) {
  RefineOptions briefly;
  briefly.small = true;
  briefly.add_diodes = false;
  briefly.max_rounds = 1;
  briefly.max_iterations = briefly.first_iterations = steps;
  briefly.trust_radius = 1e4;
  briefly.evaluation_limit = true;
  return briefly;
}

}  // namespace

void Descend(const PreparedFit& fit, std::vector<PolishStart> starts,
             const ProgressReporter& progress, Descents* descents) {
  std::vector<DescentEnd> from;
  from.reserve(starts.size());
  for (PolishStart& start : starts) from.push_back(StartOf(fit, std::move(start)));
  const auto refine = [&](const MultistartStage& stage, DescentEnd* at) {
    RefineOptions how = stage.steps > 0 ? Briefly(stage.steps) : RefineOptions();
    how.stop = progress.stop();
    const Variant& variant = fit.variants[at->group];
    const RefineProblem own = InVariant(fit.problem, variant, at->end.p);
    Take(fit.problem, variant, Refine(own, at->end.p, how), at);
  };
  RunMultistart(DescentRules(fit.options.threads, progress), std::move(from), refine, SameOptimum,
                descents);
}

int BestVisits(const Descents& descents) { return Visits(descents, SameOptimum); }

OptimumCount CountOptima(const Descents& descents) {
  const std::vector<DescentEnd>& ends = descents.ends;
  const std::vector<int> first = FirstOfOptimum(ends, SameOptimum);
  std::vector<int> independent_ends(ends.size());  // of each optimum, at its first end
  OptimumCount count;
  OptimumCount::Independent& independent = count.independent;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (first[i] < 0) continue;
    const int own = ends[i].start.beside ? 0 : 1;
    const bool best = SameOptimum(ends[first[i]], descents.Best());
    independent_ends[first[i]] += own;
    count.ends += 1;
    count.best_visits += best ? 1 : 0;
    count.local_optima += first[i] == static_cast<int>(i) ? 1 : 0;
    independent.ends += own;
    independent.best_visits += best ? own : 0;
  }
  for (const int own : independent_ends) {
    independent.local_optima += own > 0 ? 1 : 0;
    independent.once += own == 1 ? 1 : 0;
    independent.twice += own == 2 ? 1 : 0;
  }
  constexpr int kLeast = 3;
  if (independent.ends >= kLeast) {
    count.unseen = independent.once * (independent.once - 1) / (2.0 * (independent.twice + 1));
  }
  return count;
}

namespace {

constexpr int kDrawn = 40;
constexpr std::size_t kKept = 4;
constexpr double kBeside = 0.1;      // of a side: points closer than this in all sides are close
constexpr int kNext = 3;             // next settings on either side
constexpr std::size_t kSpread = 16;  // most settings spread over the range

struct Draw {
  double mean_square = 0;
  std::vector<double> x, p;
};

bool Beside(const Draw& a, const Draw& b, const Box& box) {
  for (std::size_t j = 0; j < a.x.size(); ++j) {
    if (std::fabs(a.x[j] - b.x[j]) > kBeside * (box.upper[j] - box.lower[j])) return false;
  }
  return true;
}

void AddWholeNumbers(const PreparedFit& fit, const DescentEnd& at,
                     std::vector<PolishStart>* starts) {
  const Variant& variant = fit.variants[at.start.variant];
  const int first = fit.base_size();
  std::vector<std::pair<int, double>> steps;
  for (int k = 0; k < fit.effects_size(); ++k) {
    if (variant.bounds[k].whole == 0) continue;
    steps.emplace_back(first + k, variant.bounds[k].whole);
    steps.emplace_back(first + k, -variant.bounds[k].whole);
  }
  const auto add = [&](std::vector<double> p) {
    const std::vector<double> wanted = p;
    for (int k = 0; k < fit.effects_size(); ++k) {
      p[first + k] = WithinBounds(variant.bounds[k], p[first + k]);
    }
    LeaveARest(*fit.problem.device.effects, variant.bounds, p.data() + first);
    for (const auto& [i, step] : steps) {
      if (std::fabs(p[i] - wanted[i]) > 0.5 * std::fabs(step)) return;
    }
    starts->push_back({"one more or less", std::move(p), at.start.variant, true});
  };
  for (const auto& [i, step] : steps) {
    std::vector<double> p = at.end.p;
    p[i] += step;
    add(p);
    for (const auto& [other, back] : steps) {
      if (other == i || !(step > 0) || !(back < 0)) continue;
      std::vector<double> both = p;
      both[other] += back;
      add(both);
    }
  }
}

// A parameter that is enumerated but no integer, and its trial values.
struct Setting {
  int parameter = 0;
  std::set<double> values;
};

std::vector<Setting> SettingsOf(const PreparedFit& fit, const Variant& variant) {
  const DeviceEffects& device_effects = *fit.problem.device.effects;
  std::vector<Setting> settings;
  int first = 0;
  for (const EffectUse& use : device_effects.uses) {
    const Effect& effect = *use.effect;
    for (int k = 0; k < effect.size() && effect.probes != nullptr; ++k) {
      const ParameterBounds& bounds = variant.bounds[first + k];
      const bool free = bounds.lower < bounds.upper && bounds.whole == 0;
      if (!effect.parameters[k].searched || !free) continue;
      Setting setting{fit.base_size() + first + k, {}};
      for (const Probe& probe : effect.probes(device_effects.readings.traits)) {
        if (WithinBounds(bounds, probe[k]) == probe[k]) setting.values.insert(probe[k]);
      }
      settings.push_back(std::move(setting));
    }
    first += effect.size();
  }
  return settings;
}

void AddNextSettings(const PreparedFit& fit, const DescentEnd& at,
                     std::vector<PolishStart>* starts) {
  for (const Setting& setting : SettingsOf(fit, fit.variants[at.start.variant])) {
    const double here = at.end.p[setting.parameter];
    const auto add = [&](double value) {
      starts->push_back({"next setting", at.end.p, at.start.variant, true});
      starts->back().p[setting.parameter] = value;
    };
    auto above = setting.values.upper_bound(here), below = setting.values.lower_bound(here);
    for (int step = 0; step < kNext && above != setting.values.end(); ++step) add(*above++);
    for (int step = 0; step < kNext && below != setting.values.begin(); ++step) add(*--below);
  }
}

// The end in every other variant. A parameter that only the other variant has free starts at its
// usual value.
void AddOtherVariants(const PreparedFit& fit, const DescentEnd& at,
                      std::vector<PolishStart>* starts) {
  const int first = fit.base_size();
  for (std::size_t f = 0; f < fit.variants.size(); ++f) {
    if (static_cast<int>(f) == at.start.variant) continue;
    const Variant& variant = fit.variants[f];
    std::vector<double> p = at.end.p;
    for (int k = 0; k < fit.effects_size(); ++k) {
      const ParameterBounds& before = fit.variants[at.start.variant].bounds[k];
      double& value = p[first + k];
      if (before.lower == before.upper) value = variant.usual[k];
      value = WithinBounds(variant.bounds[k], value);
    }
    LeaveARest(*fit.problem.device.effects, variant.bounds, p.data() + first);
    starts->push_back({"another variant", std::move(p), static_cast<int>(f), true});
  }
}

// Moves one parameter within its range: those that describe how an effect acts (forward voltage of
// a bypass diode, exponent of a reverse characteristic), not its strength.
void AddElsewhere(const PreparedFit& fit, const DescentEnd& at, std::vector<PolishStart>* starts) {
  constexpr double kFar = 0.15;  // of the range
  const Variant& variant = fit.variants[at.start.variant];
  int first = 0;
  for (const EffectUse& use : fit.problem.device.effects->uses) {
    const Effect& effect = *use.effect;
    for (int k = 0; k < effect.size(); ++k) {
      const ParameterBounds& bounds = variant.bounds[first + k];
      const EffectParameter& info = effect.parameters[k];
      const bool strength = k == 0 || info.scatter > 0;
      const bool free = bounds.lower < bounds.upper && bounds.whole == 0;
      if (!free || strength || info.searched) continue;
      const int i = fit.base_size() + first + k;
      const double range = bounds.upper - bounds.lower;
      for (const double part : {0.15, 0.5, 0.85}) {
        const double value = bounds.lower + part * range;
        if (std::fabs(value - at.end.p[i]) < kFar * range) continue;
        starts->push_back({"elsewhere", at.end.p, at.start.variant, true});
        starts->back().p[i] = value;
      }
    }
    first += effect.size();
  }
}

}  // namespace

std::vector<PolishStart> ShapeStarts(const PreparedFit& fit) {
  std::vector<PolishStart> starts;
  for (std::size_t f = 0; f < fit.variants.size(); ++f) {
    for (const std::vector<double>& place :
         ShapePlaces(*fit.problem.device.effects, fit.variants[f])) {
      starts.push_back({fmt::format("{}{}", kShapeOrigin, starts.size() + 1),
                        TypicalDevice(fit.problem, place), static_cast<int>(f)});
    }
  }
  return starts;
}

std::vector<PolishStart> RandomStarts(const PreparedFit& fit, const SearchSpace& space,
                                      const std::vector<double>& best, RandomStream* random) {
  const Box& box = space.box();
  std::vector<Draw> drawn;
  for (int k = 0; k < kDrawn; ++k) {
    Draw draw;
    for (int j = 0; j < space.dimensions(); ++j) {
      draw.x.push_back(box.lower[j] + random->Uniform() * (box.upper[j] - box.lower[j]));
    }
    draw.p.resize(best.size());
    space.ToParameters(draw.x.data(), draw.p.data());
    if (k % 2 == 1) std::copy(best.begin(), best.begin() + fit.base_size(), draw.p.begin());
    draw.mean_square = MeanSquare(fit.coarse, draw.p);
    if (std::isfinite(draw.mean_square)) drawn.push_back(std::move(draw));
  }
  std::stable_sort(drawn.begin(), drawn.end(),
                   [](const Draw& a, const Draw& b) { return a.mean_square < b.mean_square; });
  std::vector<const Draw*> kept;
  std::vector<PolishStart> starts;
  for (const Draw& draw : drawn) {
    if (kept.size() == kKept) break;
    const bool crowded = std::any_of(kept.begin(), kept.end(),
                                     [&](const Draw* other) { return Beside(draw, *other, box); });
    if (crowded) continue;
    kept.push_back(&draw);
    starts.push_back({"random", draw.p, space.VariantAt(draw.x.data())});
  }
  return starts;
}

std::vector<PolishStart> Neighbours(const PreparedFit& fit, const DescentEnd& at) {
  std::vector<PolishStart> starts;
  AddWholeNumbers(fit, at, &starts);
  AddNextSettings(fit, at, &starts);
  AddOtherVariants(fit, at, &starts);
  return starts;
}

std::vector<PolishStart> Elsewhere(const PreparedFit& fit, const DescentEnd& at) {
  std::vector<PolishStart> starts;
  AddElsewhere(fit, at, &starts);
  return starts;
}

std::vector<PolishStart> SpreadSettings(const PreparedFit& fit, const PolishStart& at) {
  std::vector<PolishStart> starts;
  for (const Setting& setting : SettingsOf(fit, fit.variants[at.variant])) {
    const std::vector<double> values(setting.values.begin(), setting.values.end());
    const std::size_t count = std::min(kSpread, values.size());
    for (std::size_t k = 0; k < count; ++k) {
      starts.push_back({"spread setting", at.p, at.variant});
      starts.back().p[setting.parameter] = values[(2 * k + 1) * values.size() / (2 * count)];
    }
  }
  return starts;
}

std::vector<PolishStart> Named(const std::string& origin, int variant,
                               std::vector<std::vector<double>> places) {
  std::vector<PolishStart> starts;
  starts.reserve(places.size());
  for (std::vector<double>& place : places) {
    starts.push_back({fmt::format("{} {}", origin, starts.size() + 1), std::move(place), variant});
  }
  return starts;
}

}  // namespace lyrefit
