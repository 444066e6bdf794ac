#include "lyrefit/model/string_cell_group.h"

namespace lyrefit {

StringLimits LimitsOf(const Cell<Pack>& cell) {
  StringLimits limits;
  limits.n_vt = 1.0 / cell.diode[0].inverse_n_vt;
  limits.voltage = 1e3;
  for (int d = 0; d < cell.diodes; ++d) {
    const Pack n_vt = 1.0 / cell.diode[d].inverse_n_vt;
    limits.n_vt = Smaller(limits.n_vt, n_vt);
    const Pack ratio = (abs(cell.photocurrent) + 1.0) / Larger(cell.diode[d].saturation, 1e-300);
    limits.voltage = Smaller(limits.voltage, n_vt * LogUpperBound(1.0 + ratio));
  }
  limits.bypass_vt = cell.bypass_ideality * cell.thermal_voltage;
  limits.reverse = cell.bypass;
  return limits;
}

Pack Limited(const Pack& from, const Pack& to, const Pack& limit, const Pack& unit) {
  const Pack begin = Larger(from, limit);
  const Mask beyond = begin + 2.0 * unit < to;
  if (!Any(beyond)) return to;
  const Pack rest = Larger((to - begin) / unit, 0.0);
  return Choose(beyond, begin + unit * LogUpperBound(1.0 + rest), to);
}

Pack StepDown(const Pack& newton, const Dual<1, Pack>& current, const Pack& size) {
  constexpr double kFar = 20;
  const Mask far = kFar * size < abs(current.a);
  if (!Any(far)) return newton;
  return Choose(far, current.a / current.v[0] * LogUpperBound(size / abs(current.a)), newton);
}

Pack NextVoltage(const Cell<Pack>& cell, const StringLimits& limits, const Pack& u, const Pack& way,
                 const Dual<1, Pack>& current, const Pack& size) {
  const Pack down = Choose(0.0 < u, StepDown(way, current, size), way);
  const Pack next = Limited(u, u + down, limits.voltage, limits.n_vt);
  if (cell.reverse == ReverseLaw::kShunt) return next;
  return Larger(next, -2.0 * (1.0 + 2.0 * abs(u)));  // limits steps into breakdown
}

GroupPoint PointOf(const EvaluationContext<Pack>& context, const Cell<Pack>& cell, int group,
                   const StringState& state) {
  GroupPoint point;
  point.current = JunctionCurrent(context, cell, group, Dual<1, Pack>(state.u[group], 0));
  if (!cell.two_parts) return point;
  point.far = JunctionCurrent(context, cell, group, Dual<1, Pack>(state.far[group], 0));
  const Pack far = cell.far_share, near = 1.0 - far;
  point.follows = 1.0 / (1.0 - cell.far_resistance * point.far.v[0]);
  point.behind = state.u[group] - state.far[group] + cell.far_resistance * point.far.a;
  point.current.a =
      near * point.current.a + far * (point.far.a + point.far.v[0] * point.behind * point.follows);
  point.current.v[0] = near * point.current.v[0] + far * (point.far.v[0] * point.follows);
  return point;
}

}  // namespace lyrefit
