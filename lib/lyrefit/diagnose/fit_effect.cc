#include "lyrefit/diagnose/fit_effect.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "lyrefit/estimate/refine/multistart.h"

namespace lyrefit {
namespace {

// Starts of a fit. With searched parameters: the best probe of every setting, or of the three best
// if there are more than eight. Otherwise: the two best probes.
std::vector<Direction> ChooseStarts(const Effect& effect, const std::vector<Probe>& probes,
                                    const Score& score) {
  bool searched = false;
  for (const EffectParameter& parameter : effect.parameters) searched |= parameter.searched;
  const auto settings = [&](const Direction& d) {
    std::vector<double> values;
    for (int k = 0; k < effect.size(); ++k) {
      if (effect.parameters[k].searched) values.push_back(probes[d.probe][k]);
    }
    return values;
  };
  std::set<std::vector<double>> all;
  for (const Direction& d : score.directions) all.insert(settings(d));
  searched = searched && all.size() > 1;
  const std::size_t most = !searched ? 2 : all.size() <= 8 ? all.size() : 3;
  std::vector<Direction> starts;
  std::set<std::vector<double>> taken;
  for (const Direction& d : score.directions) {
    if (starts.size() >= most) break;
    if (searched && !taken.insert(settings(d)).second) continue;
    starts.push_back(d);
  }
  return starts;
}

// The probe with its strength scaled by its score, inside the bounds.
std::vector<double> Scaled(const Effect& effect, const Probe& probe, const Direction& direction) {
  std::vector<double> p = probe;
  const EffectParameter& strength = effect.parameters.front();
  if (strength.neutral != 0 || effect.size() == 0) return p;
  bool linear = true;
  for (const EffectParameter& parameter : effect.parameters) {
    linear = linear && !(parameter.searched && effect.cell);
  }
  if (!linear) return p;  // the knee of a shaded substring moves with its depth
  const double factor = direction.score / direction.norm;
  p[0] *= factor;
  const double smallest = 1e-3 * std::fabs(probe[0]);
  if (strength.lower >= 0) p[0] = std::max(p[0], smallest);
  p[0] = std::min(std::max(p[0], 0.9 * strength.lower), 0.9 * strength.upper);
  return p;
}

// Tolerances: kBriefly for every start, kForRanking for the best of them, which goes to the end: where
// parameters are correlated, a fit that stops early stops elsewhere on every processor. The selected
// candidate is fitted again with its own noise.
const LeastSquaresOptions kBriefly = UpTo(20, 1e-5);
const LeastSquaresOptions kForRanking = UpTo(200, 1e-12);

// Sum of squares plus the penalty for freed parameters.
double Penalised(const WeightedData& weighted, const LawFit& fit) {
  return fit.sum + FreedomOf(weighted, fit.law) * NoiseVariance(weighted, fit);
}

// Whether the root mean square misfit of the used readings exceeds `part` of Isc.
bool Misses(const WeightedData& weighted, const LawFit& fit, double part) {
  double sum = 0;
  for (std::size_t k = 0; k < fit.current.size(); ++k) {
    if (weighted.used[k] == 0) continue;
    const double off = fit.current[k] - weighted.readings->points[k].current;
    sum += off * off;
  }
  return sum > part * part * std::max(weighted.count(), 1);
}

// `value`: penalised sum of squares.
struct ShapeEnd : MultistartEnd {
  LawFit fit;
};

// The best of `best` and the fits from starts suggested by the curve's shape. All start from typical
// base parameters: a base fit distorted by the fault leads to a wrong local optimum. The leading
// ones, each of a different local optimum, are fitted to the end.
LawFit TryShapes(const WeightedData& weighted, const LawFit& fit, const Effect& effect,
                 const Law& law, LawFit best) {
  const Readings& readings = *weighted.readings;
  const CurveShape shape = ShapeOf(readings);
  std::vector<ShapeEnd> starts;
  for (const ShapeStart& own : effect.starts(shape, readings.traits, {})) {
    LawFit& start = starts.emplace_back().fit;
    start.law = law;
    for (const int k : own.freed) start.law.freed.emplace_back(&effect, k);
    start.p = fit.p;
    const std::vector<double> typical = TypicalStart(readings, law, shape.At(0.02), own.giving);
    std::copy(typical.begin(), typical.end(), start.p.begin());
    start.p.insert(start.p.end(), own.p.begin(), own.p.end());
  }
  // Weights from small noise make the sum very steep near steps of the current. Where the fit without
  // the effect is ruined, starts lie far away: their first steps therefore use equal weights.
  enum { kEqualWeights, kOwnWeights };
  WeightedData alike = weighted;
  alike.path = alike.correlation = 0;
  alike.sigma.assign(weighted.sigma.size(), 0.01);
  MultistartRules rules;
  if (LeadsAstray(weighted, fit)) {
    rules.stages = {{5, 16, kEqualWeights}, {9, 16, kEqualWeights}};
  }
  rules.stages.insert(rules.stages.end(), {{5, 16, kOwnWeights}, {9, 16, kOwnWeights}});
  rules.last = {30, 8, kOwnWeights};
  rules.apart = 1e-3;
  const auto refine = [&](const MultistartStage& stage, ShapeEnd* at) {
    const WeightedData& data = stage.problem == kEqualWeights ? alike : weighted;
    const bool last = stage.steps == rules.last.steps;
    LeastSquaresOptions how = UpTo(stage.steps, 1e-5);
    if (last && best.usable) how.cutoff = Penalised(weighted, best);
    LawFit end = FitLaw(data, at->fit.law, at->fit.p, how);
    at->value = HUGE_VAL;
    if (!end.usable) return;
    at->value = Penalised(data, end);
    at->fit = std::move(end);
    if (!last || !IsItself(weighted, at->fit)) return;
    if (!best.usable || at->value < Penalised(weighted, best)) best = at->fit;
  };
  Multistart<ShapeEnd> run;
  RunMultistart(rules, std::move(starts), refine, NeverSame, &run);
  return best;
}

// Coordinate descent over the probe values of one searched parameter, for effects such as jumps:
// their scores are linear approximations, so neighbouring values may fit better.
LawFit DescendInProbes(const WeightedData& weighted, const Effect& effect,
                       const std::vector<Probe>& probes, LawFit best) {
  constexpr int kMostSteps = 8;
  std::vector<int> searched;
  for (int k = 0; k < effect.size(); ++k) {
    if (effect.parameters[k].searched) searched.push_back(k);
  }
  constexpr std::size_t kFew = 8;  // up to here every value was a start
  if (searched.size() != 1) return best;
  std::set<double> settings;
  for (const Probe& probe : probes) settings.insert(probe[searched.front()]);
  if (settings.size() <= kFew) return best;
  const std::vector<double> places(settings.begin(), settings.end());
  const std::size_t at = best.p.size() - effect.parameters.size() + searched.front();
  const auto here = std::lower_bound(places.begin(), places.end(), best.p[at]);
  const int count = static_cast<int>(places.size());
  const int start = static_cast<int>(here - places.begin());
  for (const int way : {-1, 1}) {
    int moved = 0;
    for (int k = start + way; k >= 0 && k < count && moved < kMostSteps; k += way, ++moved) {
      std::vector<double> p = best.p;
      p[at] = places[k];
      LeastSquaresOptions briefly = kBriefly;
      briefly.cutoff = best.sum;
      LawFit end = FitLaw(weighted, best.law, p, briefly);
      if (!end.usable || !(end.sum < best.sum)) break;
      best = std::move(end);
    }
    if (moved > 0) break;
  }
  return best;
}

}  // namespace

bool LeadsAstray(const WeightedData& weighted, const LawFit& fit) {
  constexpr double kMisfit = 0.01, kLeastIdeality = 0.8, kMostIdeality = 2.2;
  const double n = Ideality(fit);
  return !(n > kLeastIdeality && n < kMostIdeality) || Misses(weighted, fit, kMisfit);
}

double FreedomOf(const WeightedData& weighted, const Law& law) {
  return std::log(weighted.count()) * static_cast<double>(law.freed.size());
}

LawFit FitEffect(const WeightedData& weighted, const LawFit& fit, const Score& score,
                 Effort effort) {
  const Effect& effect = *score.effect;
  const std::vector<Probe> probes = effect.probes(weighted.readings->traits);
  Law law = fit.law;
  law.effects.push_back(&effect);
  LawFit best;
  std::vector<std::vector<double>> starts;
  for (const Direction& direction : ChooseStarts(effect, probes, score)) {
    starts.push_back(Scaled(effect, probes[direction.probe], direction));
    if (effort != Effort::kFull) break;
  }
  // A strength with a nonlinear effect is fitted from the unscaled probe as well.
  if (!starts.empty()) {
    const std::vector<double>& tried = probes[score.directions.front().probe];
    if (starts.front() != tried) starts.push_back(tried);
  }
  for (const std::vector<double>& own : starts) {
    std::vector<double> start = fit.p;
    start.insert(start.end(), own.begin(), own.end());
    LeastSquaresOptions briefly = kBriefly;
    if (best.usable) briefly.cutoff = best.sum;
    LawFit end = FitLaw(weighted, law, start, briefly);
    if (end.usable && (!best.usable || end.sum < best.sum)) best = std::move(end);
  }
  if (effect.starts != nullptr && weighted.readings->traits.single && effort == Effort::kFull) {
    best = TryShapes(weighted, fit, effect, law, std::move(best));
  }
  if (!(best.usable && best.sum <= fit.sum) && !probes.empty() && effect.size() > 0) {
    // A start at the neutral value cannot give a larger sum than the fit without the effect.
    std::vector<double> start = fit.p, absent = probes.front();
    absent[0] = effect.parameters[0].neutral;
    start.insert(start.end(), absent.begin(), absent.end());
    LawFit end = FitLaw(weighted, law, start, kBriefly);
    if (end.usable && (!best.usable || end.sum < best.sum)) best = std::move(end);
  }
  if (!best.usable) return best;
  if (effort == Effort::kFull) best = DescendInProbes(weighted, effect, probes, std::move(best));
  LawFit end = FitLaw(weighted, best.law, best.p, kForRanking);
  if (!end.usable || !IsItself(weighted, end)) return {};
  return end;
}

LawFit FitOnwards(const WeightedData& weighted, const LawFit& met) {
  LawFit end = FitLaw(weighted, met.law, met.p, kForRanking);
  if (!end.usable || !IsItself(weighted, end)) return {};
  return end;
}

LawFit FitWithout(const WeightedData& weighted, const LawFit& fit, int index) {
  Law law = fit.law;
  std::vector<double> start = fit.p;
  const int first = law.Offset(index), size = law.effects[index]->size();
  start.erase(start.begin() + first, start.begin() + first + size);
  law.effects.erase(law.effects.begin() + index);
  return FitLaw(weighted, law, start);
}

}  // namespace lyrefit
