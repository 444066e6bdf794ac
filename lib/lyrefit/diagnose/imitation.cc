#include "lyrefit/diagnose/fit_effect.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "lyrefit/diagnose/effect_size.h"
#include "lyrefit/model/effect.h"

namespace lyrefit {
namespace {

constexpr int kBeside = 4;  // readings on either side of a jump

bool StaysOffBounds(const Effect& effect, const double* p) {
  for (int k = 0; k < effect.size(); ++k) {
    const EffectParameter& parameter = effect.parameters[k];
    const double slack = 1e-3 * (parameter.upper - parameter.lower);
    if (parameter.above_lower && p[k] < parameter.lower + slack) return false;
    if (parameter.below_upper && p[k] > parameter.upper - slack) return false;
  }
  return true;
}

// Whether the cells of the law, lit and without its effects, give more voltage than their junctions
// can: what takes the rest is then no cause, but a reading of Voc that is off, or cells miscounted.
bool GivesTooMuch(const WeightedData& weighted, const LawFit& fit) {
  const double most = weighted.readings->traits.most_open_circuit;
  if (!(most > 0)) return false;
  Readings at = InBrightestLight(*weighted.readings);
  at.points.front().voltage = most;
  const LawFit rest = WithoutEffects(fit);
  LawWorkspace workspace;
  double current = 0;
  return EvaluateLaw(rest.law, at, rest.p.data(), &workspace, &current, nullptr) && current > 0;
}

// What the last effect adds to the current of each reading. Empty if the law without it cannot be
// evaluated.
std::vector<double> AddedBy(const WeightedData& weighted, const LawFit& fit) {
  const LawFit rest = TakenOut(fit, static_cast<int>(fit.law.effects.size()) - 1);
  std::vector<double> added(fit.current.size());
  LawWorkspace workspace;
  if (!EvaluateLaw(rest.law, *weighted.readings, rest.p.data(), &workspace, added.data(),
                   nullptr)) {
    return {};
  }
  for (std::size_t k = 0; k < added.size(); ++k) added[k] = fit.current[k] - added[k];
  return added;
}

// The first of the two neighbours between which the added current changes by more than half of its
// range; -1 if there are none.
int JumpOf(const std::vector<Reading>& points, const std::vector<double>& added) {
  constexpr double kSudden = 0.5;
  const auto [least, most] = std::minmax_element(added.begin(), added.end());
  double largest = kSudden * (*most - *least);
  int at = -1;
  for (int k = 0; k + 1 < static_cast<int>(points.size()); ++k) {
    if (points[k].segment != points[k + 1].segment) continue;
    const double change = std::fabs(added[k + 1] - added[k]);
    if (!(change > largest)) continue;
    largest = change;
    at = k;
  }
  return at;
}

// Takes a straight line along the voltage out of values, all of equal weight.
void TakeOutLine(const std::vector<double>& voltage, std::vector<double>* values) {
  const auto n = static_cast<double>(values->size());
  double mean = 0, middle = 0, along = 0, moment = 0;
  for (std::size_t k = 0; k < values->size(); ++k) {
    mean += (*values)[k] / n;
    middle += voltage[k] / n;
  }
  for (std::size_t k = 0; k < values->size(); ++k) {
    along += (voltage[k] - middle) * ((*values)[k] - mean);
    moment += (voltage[k] - middle) * (voltage[k] - middle);
  }
  for (std::size_t k = 0; k < values->size(); ++k) {
    (*values)[k] -= mean + (moment > 0 ? along / moment * (voltage[k] - middle) : 0);
  }
}

// Whether the readings beside a jump show it. A bend of the device that a jump describes from afar
// is smooth there.
bool Jumps(const WeightedData& weighted, const LawFit& fit, const std::vector<double>& added,
           int at) {
  constexpr int kFewest = 5;
  constexpr double kLeastPart = 0.5, kSure = 2;  // of the jump; standard errors
  const std::vector<Reading>& points = weighted.readings->points;
  const int last = std::min(at + kBeside, static_cast<int>(points.size()) - 1);
  std::vector<double> voltage, jump, seen;
  double variance = 0;
  for (int k = std::max(0, at + 1 - kBeside); k <= last; ++k) {
    if (points[k].segment != points[at].segment || weighted.used[k] == 0) continue;
    voltage.push_back(points[k].voltage);
    jump.push_back(added[k]);
    seen.push_back(points[k].current - fit.current[k] + added[k]);
    variance = std::max(variance, weighted.sigma[k] * weighted.sigma[k]);
  }
  if (static_cast<int>(voltage.size()) < kFewest) return true;
  TakeOutLine(voltage, &jump);
  TakeOutLine(voltage, &seen);
  double square = 0, product = 0;
  for (std::size_t k = 0; k < jump.size(); ++k) {
    square += jump[k] * jump[k];
    product += jump[k] * seen[k];
  }
  const double part = product / square;
  const double error = std::sqrt(variance * NoiseVariance(weighted, fit) / square);
  return !(part < kLeastPart && part + kSure * error < 1);
}

// Whether an effect begins or acts where devices bend by themselves: at 0 V of a sweep from deep
// reverse, where the field in the junction grows and with it the current that is collected, and, of
// a moment of light, at open circuit of a single cell, where contacts of new materials block or begin
// to inject. `jump`: of JumpOf.
bool LiesAtABend(const Readings& readings, const std::vector<double>& added, int jump) {
  constexpr double kBegun = 0.1, kHalf = 0.5;  // of the largest change
  const DataTraits& traits = readings.traits;
  const bool deep = traits.open_circuit > 0 && traits.lowest_voltage < -traits.open_circuit;
  double largest = 0;
  for (const double change : added) largest = std::max(largest, std::fabs(change));
  const std::vector<Reading>& points = readings.points;
  for (int k = 0; k + 1 < static_cast<int>(points.size()); ++k) {
    const Reading &a = points[k], &b = points[k + 1];
    if (a.segment != b.segment) continue;
    const auto held = [&](double part) {
      return jump < 0 ? std::fabs(added[k]) > part * largest : std::abs(k - jump) < kBeside;
    };
    if (deep && (a.voltage < 0) != (b.voltage < 0) && held(kHalf)) return true;
    const bool at_voc = jump < 0 && !traits.module && (a.current < 0) != (b.current < 0);
    if (at_voc && held(kBegun)) return true;
  }
  return false;
}

// Whether an effect by which the light stays at another level acts where a device bends by itself:
// in the knee, or where shade makes a step, near the edge of a bypass group, of equal ones or with
// half of the cells in the middle one. In strings of modules an edge is near everywhere.
bool StaysAfterABend(const Readings& readings, const std::vector<double>& added) {
  constexpr double kBegun = 0.1, kHalf = 0.5, kDone = 0.9;  // of the largest change
  constexpr double kStays = 0.15;                           // likewise; near Voc Rs hides light
  constexpr double kKnee = 0.3;                             // of the largest current
  constexpr double kBelow = 0.08,
                   kAbove = 0.03;  // of Voc: groups give less at a current than at Voc
  constexpr int kMostOfAModule = 4;
  const std::vector<Reading>& points = readings.points;
  const DataTraits& traits = readings.traits;
  if (!traits.turns.empty() || added.size() != points.size()) return false;
  double largest = 0, most = 0;
  for (const double change : added) largest = std::max(largest, std::fabs(change));
  for (const Reading& point : points) most = std::max(most, point.current);
  if (!(std::fabs(added.back()) > kStays * largest)) return false;
  const auto first_of = [&](double part) {
    const auto at = std::find_if(added.begin(), added.end(),
                                 [&](double change) { return std::fabs(change) > part * largest; });
    return points[at - added.begin()];
  };
  if (first_of(kBegun).current < kKnee * most || first_of(kDone).current < kKnee * most)
    return true;
  const double rise = points.back().voltage - points.front().voltage;
  const bool takes = (added.back() < 0) == (rise > 0);  // as the voltage rises; shade does
  if (!traits.module || !takes) return false;
  const int groups = SubstringsOf(traits);
  if (groups > kMostOfAModule) return true;
  const double voc = traits.open_circuit > 0 ? traits.open_circuit : traits.highest_voltage;
  const double part = first_of(kHalf).voltage / voc;
  std::vector<double> edges = {0.25, 0.5, 0.75};
  for (int j = 1; j < groups; ++j) edges.push_back(static_cast<double>(j) / groups);
  return std::any_of(edges.begin(), edges.end(),
                     [part](double edge) { return part > edge - kBelow && part < edge + kAbove; });
}

}  // namespace

bool IsItself(const WeightedData& weighted, const LawFit& fit) {
  const Effect& effect = *fit.law.effects.back();
  const Readings& readings = *weighted.readings;
  const double* const p = fit.p.data() + fit.p.size() - effect.parameters.size();
  if (!StaysOffBounds(effect, p) || GivesTooMuch(weighted, fit)) return false;
  if (effect.imitates != nullptr && effect.imitates(p, readings.traits)) return false;
  if (effect.where == Where::kDevice || effect.size() == 0) return true;
  const std::vector<double> added = AddedBy(weighted, fit);
  if (added.empty()) return true;
  const int jump = JumpOf(readings.points, added);
  if (jump >= 0 && !Jumps(weighted, fit, added, jump)) return false;
  // No junction has more: what bends such a curve is of the device.
  constexpr double kMostIdeality = 2.2;
  if (effect.momentary && Ideality(fit) > kMostIdeality) return false;
  if (effect.momentary && jump < 0 && StaysAfterABend(readings, added)) return false;
  const bool at_moment = effect.momentary || jump >= 0;
  return !(at_moment && LiesAtABend(readings, added, jump));
}

}  // namespace lyrefit
