#include "lyrefit/law/string.h"

namespace lyrefit {
namespace {

using every_processor::Any;

constexpr double kShort = 1e-9;      // of a voltage: after such a step the next is below rounding
constexpr double kRounding = 4e-16;  // of a current

// An upper bound of ln(x), x > 0, never more than 0.07 above it.
Pack LogBound(const Pack& x) { return every_processor::LaneByLane(x, LogUpperBound); }

// A step that leads beyond `limit` goes on by the logarithm of the rest, in units of `unit`.
Pack Limited(const Pack& from, const Pack& to, const Pack& limit, const Pack& unit) {
  const Pack begin = Larger(from, limit);
  const Mask beyond = begin + 2.0 * unit < to;
  if (!Any(beyond)) return to;
  const Pack rest = Larger((to - begin) / unit, 0.0);
  return Choose(beyond, begin + unit * LogBound(1.0 + rest), to);
}

KindPoint PointOf(const Bench<Pack>& bench, const Cell<Pack>& cell, int kind, const Pack& at) {
  const Dual<1, Pack> u(at, 0);
  KindPoint point;
  point.far = JunctionCurrent(bench, cell, kind, u);
  if (!cell.halved) {
    point.voltage = u;
    point.current = point.far;
    return point;
  }
  point.voltage = u - point.far * (0.5 * cell.lateral);
  point.near = JunctionCurrent(bench, cell, kind, Dual<1, Pack>(point.voltage.a, 0));
  point.current = 0.5 * (point.near.Chain(point.near.a, point.voltage.v[0]) + point.far);
  return point;
}

// All that the equations are made of, at a state.
struct Terms {
  KindPoint kind[kMostKinds];
  Dual<1, Pack> bypass[kMostKinds];  // of each part, with its slope by the part's voltage
  Dual<1, Pack> drop[kMostKinds];    // of each string
};

void TermsAt(const Bench<Pack>& bench, const Cell<Pack>& cell, const StringState& state,
             Terms* terms) {
  for (int g = 0; g < cell.kinds; ++g) terms->kind[g] = PointOf(bench, cell, g, state.u[g]);
  for (int s = 0; s < cell.strings; ++s) {
    terms->drop[s] = SeriesDrop(bench, cell, Dual<1, Pack>(state.current[s], 0));
  }
  for (int p = 0; p < cell.parts; ++p) {
    if (!cell.part[p].bypassed) continue;
    terms->bypass[p] =
        BypassCurrent(cell, cell.part[p].cells, -Dual<1, Pack>(state.part_voltage[p], 0));
  }
}

// The linear system at a state, solved. Cells that are all alike are one kind in one part.
struct Linear {
  Pack weight[kMostKinds];        // of each part
  Pack mean_voltage[kMostKinds];  // of its cells
  Pack stiffness[kMostKinds];     // its mean dv/dF
  Pack divider[kMostKinds];
  Pack level[kMostKinds];  // U = level + slope x (I - present I)
  Pack slope[kMostKinds];
  Pack string_weight[kMostKinds];
  Pack string_slope[kMostKinds];
  Pack current[kMostKinds];       // of each string, new
  Pack part_current[kMostKinds];  // of each part's cells, new
  Pack part_voltage[kMostKinds];
};

int PartOf(const Cell<Pack>& cell, int kind) { return cell.kinds == 1 ? 0 : cell.kind[kind].part; }
Pack ShareOf(const Cell<Pack>& cell, int kind) {
  return cell.kinds == 1 ? Pack(1.0) : cell.kind[kind].share;
}

// Means over the kinds of each part, and the current that its cells carry at present.
void SumKinds(const Cell<Pack>& cell, const Terms& terms, Linear* linear, Pack* present,
              Pack* mismatch) {
  bool seen[kMostKinds] = {};
  for (int p = 0; p < cell.parts; ++p) {
    linear->weight[p] = linear->mean_voltage[p] = linear->stiffness[p] = mismatch[p] = 0.0;
  }
  for (int g = 0; g < cell.kinds; ++g) {
    const KindPoint& point = terms.kind[g];
    const int p = PartOf(cell, g);
    const Pack share = ShareOf(cell, g);
    const Pack slope = share * (point.voltage.v[0] / point.current.v[0]);
    if (!seen[p]) present[p] = point.current.a;
    seen[p] = true;
    linear->weight[p] = linear->weight[p] + share;
    linear->mean_voltage[p] = linear->mean_voltage[p] + share * point.voltage.a;
    linear->stiffness[p] = linear->stiffness[p] + slope;
    mismatch[p] = mismatch[p] + (point.current.a - present[p]) * slope;
  }
  for (int p = 0; p < cell.parts; ++p) {
    const Pack inverse = 1.0 / linear->weight[p];
    linear->mean_voltage[p] = linear->mean_voltage[p] * inverse;
    linear->stiffness[p] = linear->stiffness[p] * inverse;
    mismatch[p] = mismatch[p] * inverse;
  }
}

void SolveLinear(const Cell<Pack>& cell, const Pack& voltage, const StringState& state,
                 const Terms& terms, Linear* linear) {
  Pack present[kMostKinds], mismatch[kMostKinds], string_level[kMostKinds];
  SumKinds(cell, terms, linear, present, mismatch);
  for (int s = 0; s < cell.strings; ++s) {
    linear->string_weight[s] = linear->string_slope[s] = string_level[s] = 0.0;
  }
  for (int p = 0; p < cell.parts; ++p) {
    const int s = cell.part[p].string;
    Pack into_cells = state.current[s] - present[p];
    linear->divider[p] = 1.0;
    if (cell.part[p].bypassed) {
      const Dual<1, Pack>& bypass = terms.bypass[p];
      into_cells = into_cells - bypass.a + bypass.v[0] * state.part_voltage[p];
      linear->divider[p] = 1.0 / (1.0 + linear->stiffness[p] * bypass.v[0]);
    }
    linear->level[p] = (linear->mean_voltage[p] - mismatch[p] + into_cells * linear->stiffness[p] -
                        terms.drop[s].a) *
                       linear->divider[p];
    linear->slope[p] = (linear->stiffness[p] - terms.drop[s].v[0]) * linear->divider[p];
    linear->string_weight[s] = linear->string_weight[s] + linear->weight[p];
    linear->string_slope[s] = linear->string_slope[s] + linear->weight[p] * linear->slope[p];
    string_level[s] = string_level[s] + linear->weight[p] * linear->level[p];
  }
  Pack shift[kMostKinds];
  for (int s = 0; s < cell.strings; ++s) {
    shift[s] = (voltage * linear->string_weight[s] - string_level[s]) / linear->string_slope[s];
    linear->current[s] = state.current[s] + shift[s];
  }
  for (int p = 0; p < cell.parts; ++p) {
    const int s = cell.part[p].string;
    linear->part_voltage[p] = linear->level[p] + shift[s] * linear->slope[p];
    linear->part_current[p] = linear->current[s];
    if (!cell.part[p].bypassed) continue;
    const Dual<1, Pack>& bypass = terms.bypass[p];
    linear->part_current[p] = linear->part_current[p] - bypass.a -
                              (linear->part_voltage[p] - state.part_voltage[p]) * bypass.v[0];
  }
}

Mask IsShort(const Pack& step, const Pack& of) { return abs(step) < kShort * (1.0 + abs(of)); }

// Moves the state by a step; the lanes that have arrived.
Mask Move(const Cell<Pack>& cell, const StringLimits& limits, const Terms& terms,
          const Linear& linear, StringState* state) {
  Mask done = Pack(0.0) < 1.0;
  for (int g = 0; g < cell.kinds; ++g) {
    const Dual<1, Pack>& present = terms.kind[g].current;
    const Pack& current = linear.part_current[PartOf(cell, g)];
    const Pack missing = current - present.a;
    const Pack next =
        Limited(state->u[g], state->u[g] + missing / present.v[0], limits.voltage, limits.n_vt);
    done = done &
           ((abs(missing) < kRounding * (1.0 + abs(current))) | IsShort(next - state->u[g], next));
    state->u[g] = next;
  }
  for (int p = 0; p < cell.parts; ++p) {
    Pack next = linear.part_voltage[p];
    if (cell.part[p].bypassed) {
      const double cells = cell.part[p].cells;
      const Pack before = state->part_voltage[p];
      next = -1 / cells * Limited(-cells * before, -cells * next, limits.reverse, limits.bypass_vt);
      const Dual<1, Pack>& bypass = terms.bypass[p];
      done = done & ((abs(bypass.v[0] * (next - before)) < kRounding * (1.0 + abs(bypass.a))) |
                     IsShort(cells * (next - before), cells * next));
    }
    state->part_voltage[p] = next;
  }
  for (int s = 0; s < cell.strings; ++s) state->current[s] = linear.current[s];
  return done;
}

// By implicit differentiation of the equations above, where they hold.
void FindSlopes(const Cell<Pack>& cell, const Pack& voltage, const Terms& terms,
                const Linear& linear, StringSlopes* slopes) {
  Pack scale[kMostKinds];  // of each string: its part in the sum of currents over its slope
  for (int s = 0; s < cell.strings; ++s) {
    scale[s] = linear.string_weight[s] / linear.string_slope[s];
    slopes->by_terminal[s] = scale[s] * linear.string_weight[s];
    slopes->by_drop[s] = 0.0;
  }
  for (int p = 0; p < cell.parts; ++p) {
    const int s = cell.part[p].string;
    const Pack weight = scale[s] * linear.weight[p] * linear.divider[p];
    slopes->by_bypass[p] = weight * linear.stiffness[p];
    slopes->by_drop[s] = slopes->by_drop[s] + weight;
  }
  for (int g = 0; g < cell.kinds; ++g) {
    const KindPoint& point = terms.kind[g];
    const int p = PartOf(cell, g);
    const int s = cell.part[p].string;
    const Pack share = scale[s] * ShareOf(cell, g) * linear.divider[p];
    slopes->by_current[g] = share * (point.voltage.v[0] / point.current.v[0]);
    slopes->by_voltage[g] = -share;
    slopes->by_share[g] =
        linear.current[s] +
        scale[s] * (voltage - linear.part_voltage[p] -
                    linear.divider[p] * (point.voltage.a - linear.mean_voltage[p]));
  }
}

}  // namespace

StringLimits LimitsOf(const Cell<Pack>& cell) {
  StringLimits limits;
  limits.n_vt = 1.0 / cell.diode[0].inverse_n_vt;
  limits.voltage = 1e3;
  // What a halved cell's far half may carry before the near half's voltage runs away.
  const Pack spare = cell.halved ? Smaller(1.0, 0.1 / Larger(cell.lateral, 1e-3)) : Pack(1.0);
  for (int d = 0; d < cell.diodes; ++d) {
    const Pack n_vt = 1.0 / cell.diode[d].inverse_n_vt;
    limits.n_vt = Smaller(limits.n_vt, n_vt);
    const Pack ratio = (abs(cell.photocurrent) + spare) / Larger(cell.diode[d].saturation, 1e-300);
    limits.voltage = Smaller(limits.voltage, n_vt * LogBound(1.0 + ratio));
  }
  if (cell.halved) {  // the near half's voltage moves by so much more
    const Pack steepness = (abs(cell.photocurrent) + 1.0) / limits.n_vt;
    limits.n_vt = limits.n_vt / (1.0 + 0.5 * cell.lateral * steepness);
  }
  limits.bypass_vt = 1.2 * cell.thermal_voltage;
  limits.reverse = cell.bypass;
  return limits;
}

StringRoot SolveString(const Bench<Pack>& bench, const Cell<Pack>& cell, const StringLimits& limits,
                       const Pack& voltage, StringState* state) {
  constexpr int kMostSteps = 100;
  Terms terms;
  Linear linear;
  for (int k = 0; k < kMostSteps; ++k) {
    TermsAt(bench, cell, *state, &terms);
    SolveLinear(cell, voltage, *state, terms, &linear);
    if (All(Move(cell, limits, terms, linear, state))) break;
  }
  StringRoot root;
  for (int g = 0; g < cell.kinds; ++g) root.kind[g] = terms.kind[g];
  root.current = 0.0;
  for (int s = 0; s < cell.strings; ++s) {
    root.current = root.current + linear.string_weight[s] * linear.current[s];
  }
  FindSlopes(cell, voltage, terms, linear, &root.slopes);
  return root;
}

}  // namespace lyrefit
