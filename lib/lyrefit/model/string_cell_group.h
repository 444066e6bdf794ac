#pragma once

#include <cstring>
#include <utility>

#include "lyrefit/model/string.h"

// Functions of one cell group, for the Newton solver (string_solve.h) and the bracketed one
// (string.cc). P: a pack.
namespace lyrefit {

template <class P>
using MaskOf = decltype(std::declval<P>() < std::declval<P>());

constexpr double kShort = 1e-9;      // relative voltage step after which the next is below rounding
constexpr double kRounding = 3e-15;  // relative rounding error of sums of currents

// Add the terms of the effects at eight voltages or currents, and their slopes. `cell`: a Cell of
// packs.
void AddJunctionTerms(const StringEffects& effects, const void* cell, const Block& light,
                      const Block& voltage, Block* current, Block* slope);
void AddSeriesTerms(const StringEffects& effects, const void* cell, const Block& current,
                    Block* drop, Block* slope);

template <class P>
int SubstringOf(const Cell<P>& cell, int group) {
  return cell.groups == 1 ? 0 : cell.group[group].substring;
}
template <class P>
P ShareOf(const Cell<P>& cell, int group) {
  return cell.groups == 1 ? P(1.0) : cell.group[group].share;
}
template <class P>
bool IsBeside(const Cell<P>& cell, int group) {
  return cell.groups > 1 && cell.group[group].beside;
}
template <class P>
MaskOf<P> IsShort(const P& step, const P& of) {
  return abs(step) < kShort * (1.0 + abs(of));
}

// F(Vj): the current that one cell group delivers at its junction voltage, with its slope.
template <class P>
Dual<1, P> JunctionCurrent(const StringEffects& effects, const Cell<P>& cell, int group,
                           const P& junction) {
  const Dual<1, P> voltage(junction, 0);
  const bool alike = cell.groups == 1;
  const P light = alike ? cell.photocurrent : cell.photocurrent * cell.group[group].light;
  const P leak = alike ? P(kLeastConductance) : cell.group[group].leak + kLeastLeak;
  Dual<1, P> current = light - voltage * (cell.conductance + leak);
  for (int d = 0; d < cell.diodes; ++d) {
    const Diode<P>& diode = cell.diode[d];
    current = current + DiodeCurrent(diode.saturation, diode.inverse_n_vt, voltage);
  }
  if (cell.reverse == ReverseLaw::kShunt && !effects.junction) return current;
  Dual<1, P> more = 0.0;
  if (cell.reverse != ReverseLaw::kShunt) more = ReverseCurrent(cell, voltage);
  if (effects.junction) {
    Block at, in, value, slope;
    std::memcpy(&at, &junction, sizeof(P));
    std::memcpy(&in, &light, sizeof(P));
    std::memcpy(&value, &more.a, sizeof(P));
    std::memcpy(&slope, &more.v[0], sizeof(P));
    AddJunctionTerms(effects, &cell, in, at, &value, &slope);
    std::memcpy(&more.a, &value, sizeof(P));
    std::memcpy(&more.v[0], &slope, sizeof(P));
  }
  return current + more;
}

// The series drop D(I), with its slope.
template <class P>
Dual<1, P> SeriesDrop(const StringEffects& effects, const Cell<P>& cell, const P& current) {
  Dual<1, P> drop = Dual<1, P>(current, 0) * cell.resistance;
  if (!effects.series || cell.suns_voc) return drop;
  Block at, value, slope;
  Dual<1, P> more = 0.0;
  std::memcpy(&at, &current, sizeof(P));
  std::memcpy(&value, &more.a, sizeof(P));
  std::memcpy(&slope, &more.v[0], sizeof(P));
  AddSeriesTerms(effects, &cell, at, &value, &slope);
  std::memcpy(&more.a, &value, sizeof(P));
  std::memcpy(&more.v[0], &slope, sizeof(P));
  return drop + more;
}

// Limits a step: beyond `limit` the rest is replaced by its logarithm, in units of `unit`.
template <class P>
P Limited(const P& from, const P& to, const P& limit, const P& unit) {
  const P begin = Larger(from, limit);
  const MaskOf<P> beyond = begin + 2.0 * unit < to;
  if (!Any(beyond)) return to;
  const P rest = Larger((to - begin) / unit, 0.0);
  return Choose(beyond, begin + unit * LogUpperBound(1.0 + rest), to);
}

// Newton's step towards a current of at most `size`. Far up an exponential, where Newton's steps
// have constant length, the step of the logarithm is used.
template <class P>
P StepDown(const P& newton, const Dual<1, P>& current, const P& size) {
  constexpr double kFar = 20;
  const MaskOf<P> far = kFar * size < abs(current.a);
  if (!Any(far)) return newton;
  return Choose(far, current.a / current.v[0] * LogUpperBound(size / abs(current.a)), newton);
}

// Next voltage of one junction, from a Newton step `way`.
template <class P>
P NextVoltage(const Cell<P>& cell, const StringLimitsOf<P>& limits, const P& u, const P& way,
              const Dual<1, P>& current, const P& size) {
  const P down = Choose(0.0 < u, StepDown(way, current, size), way);
  const P next = Limited(u, u + down, limits.voltage, limits.n_vt);
  if (cell.reverse == ReverseLaw::kShunt) return next;
  return Larger(next, -2.0 * (1.0 + 2.0 * abs(u)));  // limits steps into breakdown
}

// Current of a cell group at the voltages of a state.
template <class P>
GroupPointOf<P> PointOf(const StringEffects& effects, const Cell<P>& cell, int group,
                        const StringStateOf<P>& state) {
  GroupPointOf<P> point;
  point.current = JunctionCurrent(effects, cell, group, state.u[group]);
  if (!cell.two_parts) return point;
  point.far = JunctionCurrent(effects, cell, group, state.far[group]);
  const P far = cell.far_share, near = 1.0 - far;
  point.follows = 1.0 / (1.0 - cell.far_resistance * point.far.v[0]);
  point.behind = state.u[group] - state.far[group] + cell.far_resistance * point.far.a;
  point.current.a =
      near * point.current.a + far * (point.far.a + point.far.v[0] * point.behind * point.follows);
  point.current.v[0] = near * point.current.v[0] + far * (point.far.v[0] * point.follows);
  return point;
}

}  // namespace lyrefit
