#include "lyrefit/model/string.h"

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/string_brackets.h"
#include "lyrefit/model/string_cell_group.h"

namespace lyrefit {
namespace {

using every_processor::Any;

// All terms of the equations at a state.
struct Terms {
  GroupPoint group[kMostGroups];
  Dual<1, Pack> bypass[kMostGroups];         // of each substring, slope by its voltage
  Dual<1, Pack> drop[kMostGroups];           // of each string
  Dual<1, Pack> chain_drop[kMostGroups][2];  // of both chains of a parallel substring
};

// The cell group whose current is that of a chain of a parallel substring.
int GroupOfChain(const Cell<Pack>& cell, int substring, int chain) {
  int g = 0;
  while (cell.group[g].substring != substring || cell.group[g].beside != (chain == 1)) ++g;
  return g;
}

void TermsAt(const EvaluationContext<Pack>& context, const Cell<Pack>& cell,
             const StringState& state, Terms* terms) {
  for (int g = 0; g < cell.groups; ++g) terms->group[g] = PointOf(context, cell, g, state);
  for (int s = 0; s < cell.strings; ++s) {
    terms->drop[s] = SeriesDrop(context, cell, Dual<1, Pack>(state.current[s], 0));
  }
  for (int p = 0; p < cell.substrings; ++p) {
    if (!cell.substring[p].bypassed) continue;
    terms->bypass[p] =
        BypassCurrent(cell, cell.substring[p].cells, -Dual<1, Pack>(state.substring_voltage[p], 0));
  }
  for (int p = 0; p < cell.substrings; ++p) {
    for (int c = 0; cell.substring[p].parallel && c < 2; ++c) {
      const Pack& current = terms->group[GroupOfChain(cell, p, c)].current.a;
      terms->chain_drop[p][c] = SeriesDrop(context, cell, Dual<1, Pack>(current, 0));
    }
  }
}

// Linearised current of a chain of a parallel substring: present + (U - level) x inverse.
struct Chain {
  Pack present;
  Pack level;
  Pack inverse;
  Pack At(const Pack& voltage) const { return present + (voltage - level) * inverse; }
};

// Solution of the linear system at a state. Identical cells are one cell group in one substring.
struct Linear {
  Pack weight[kMostGroups];        // of each substring
  Pack mean_voltage[kMostGroups];  // of the cells of each substring
  Pack stiffness[kMostGroups];     // mean du/dF of each substring
  Pack divider[kMostGroups];
  Pack level[kMostGroups];  // substring: U = level + slope x (I - present I)
  Pack slope[kMostGroups];
  Pack string_weight[kMostGroups];
  Pack string_slope[kMostGroups];
  Pack current[kMostGroups];            // of each string, after the step
  Pack substring_current[kMostGroups];  // of each substring's cells, after the step
  Pack substring_voltage[kMostGroups];
  Chain chain[kMostGroups][2];
  Pack beside_current[kMostGroups];  // of the second chain, after the step
};

// Means over the cell groups of each substring, and the present current of its cells.
void SumGroups(const Cell<Pack>& cell, const StringState& state, const Terms& terms, Linear* linear,
               Pack* present, Pack* mismatch) {
  bool seen[kMostGroups] = {};
  for (int p = 0; p < cell.substrings; ++p) {
    linear->weight[p] = linear->mean_voltage[p] = linear->stiffness[p] = mismatch[p] = 0.0;
  }
  for (int g = 0; g < cell.groups; ++g) {
    if (IsBeside(cell, g)) continue;
    const GroupPoint& point = terms.group[g];
    const int p = SubstringOf(cell, g);
    const Pack share = ShareOf(cell, g);
    const Pack slope = share / point.current.v[0];
    if (!seen[p]) present[p] = point.current.a;
    seen[p] = true;
    linear->weight[p] = linear->weight[p] + share;
    linear->mean_voltage[p] = linear->mean_voltage[p] + share * state.u[g];
    linear->stiffness[p] = linear->stiffness[p] + slope;
    mismatch[p] = mismatch[p] + (point.current.a - present[p]) * slope;
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const Pack inverse = 1.0 / linear->weight[p];
    linear->mean_voltage[p] = linear->mean_voltage[p] * inverse;
    linear->stiffness[p] = linear->stiffness[p] * inverse;
    mismatch[p] = mismatch[p] * inverse;
  }
}

// Level and slope of a substring of two chains, as functions of their total current.
void SolvePair(const Cell<Pack>& cell, int p, const StringState& state, const Terms& terms,
               const Pack& present, const Pack& mismatch, Linear* linear) {
  const int g = GroupOfChain(cell, p, 1);
  const Dual<1, Pack>& beside = terms.group[g].current;
  const Dual<1, Pack>*drop = terms.chain_drop[p], &bypass = terms.bypass[p];
  Chain* chain = linear->chain[p];
  chain[0] = {present, linear->mean_voltage[p] - mismatch - drop[0].a,
              1.0 / (linear->stiffness[p] - drop[0].v[0])};
  chain[1] = {beside.a, state.u[g] - drop[1].a, 1.0 / (1.0 / beside.v[0] - drop[1].v[0])};
  Pack slope = 0.5 * (chain[0].inverse + chain[1].inverse);
  Pack rest = state.current[cell.substring[p].string] - 0.5 * (chain[0].At(0.0) + chain[1].At(0.0));
  if (cell.substring[p].bypassed) {
    slope = slope + bypass.v[0];
    rest = rest - bypass.a + bypass.v[0] * state.substring_voltage[p];
  }
  linear->slope[p] = 1.0 / slope;
  linear->level[p] = rest * linear->slope[p];
}

// Changes of the string currents, given level and slope of every substring.
void SolveStrings(const Cell<Pack>& cell, const Pack& voltage, Linear* linear, Pack* shift) {
  Pack level[kMostGroups];
  for (int s = 0; s < cell.strings; ++s) {
    linear->string_weight[s] = linear->string_slope[s] = level[s] = 0.0;
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const int s = cell.substring[p].string;
    linear->string_weight[s] = linear->string_weight[s] + linear->weight[p];
    linear->string_slope[s] = linear->string_slope[s] + linear->weight[p] * linear->slope[p];
    level[s] = level[s] + linear->weight[p] * linear->level[p];
  }
  for (int s = 0; s < cell.strings; ++s) {
    shift[s] = (voltage * linear->string_weight[s] - level[s]) / linear->string_slope[s];
  }
}

// Clamps substrings that the linear step drives far below the voltage at which their bypass diode
// conducts: they stay where it carries one current scale. Returns whether there are any.
bool ClampSubstrings(const Cell<Pack>& cell, const StringLimits& limits, const StringState& state,
                     const Pack* shift, Linear* linear, Mask* clamped) {
  bool any = false;
  for (int p = 0; p < cell.substrings; ++p) {
    if (!cell.substring[p].bypassed) continue;
    const double cells = cell.substring[p].cells;
    const Pack on = -limits.reverse / cells, far = on - 3.0 / cells * limits.bypass_vt;
    const Pack next = linear->level[p] + shift[cell.substring[p].string] * linear->slope[p];
    const Mask below = (next < far) & (on < state.substring_voltage[p]) & (!clamped[p]);
    if (!Any(below)) continue;
    any = true;
    clamped[p] = clamped[p] | below;
    linear->level[p] = Choose(below, on, linear->level[p]);
    linear->slope[p] = Choose(below, -limits.bypass_vt / cells, linear->slope[p]);
  }
  return any;
}

// SolveLinear for identical cells.
void SolveAlike(const Pack& voltage, const StringState& state, const Terms& terms, Linear* linear) {
  const Dual<1, Pack>&current = terms.group[0].current, &drop = terms.drop[0];
  linear->weight[0] = linear->divider[0] = linear->string_weight[0] = 1.0;
  linear->mean_voltage[0] = state.u[0];
  linear->stiffness[0] = 1.0 / current.v[0];
  linear->level[0] = state.u[0] + (state.current[0] - current.a) * linear->stiffness[0] - drop.a;
  linear->slope[0] = linear->string_slope[0] = linear->stiffness[0] - drop.v[0];
  const Pack shift = (voltage - linear->level[0]) / linear->slope[0];
  linear->current[0] = linear->substring_current[0] = state.current[0] + shift;
  linear->substring_voltage[0] = linear->level[0] + shift * linear->slope[0];
}

void SolveLinear(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const StringState& state, const Terms& terms, Linear* linear) {
  if (cell.groups == 1) return SolveAlike(voltage, state, terms, linear);
  Pack present[kMostGroups], mismatch[kMostGroups], shift[kMostGroups];
  Mask clamped[kMostGroups];
  SumGroups(cell, state, terms, linear, present, mismatch);
  for (int p = 0; p < cell.substrings; ++p) {
    const int s = cell.substring[p].string;
    Pack into_cells = state.current[s] - present[p];
    clamped[p] = Pack(1.0) < 0.0;
    linear->divider[p] = 1.0;
    if (cell.substring[p].parallel) {
      SolvePair(cell, p, state, terms, present[p], mismatch[p], linear);
      continue;
    }
    if (cell.substring[p].bypassed) {
      const Dual<1, Pack>& bypass = terms.bypass[p];
      into_cells = into_cells - bypass.a + bypass.v[0] * state.substring_voltage[p];
      linear->divider[p] = 1.0 / (1.0 + linear->stiffness[p] * bypass.v[0]);
    }
    linear->level[p] = (linear->mean_voltage[p] - mismatch[p] + into_cells * linear->stiffness[p] -
                        terms.drop[s].a) *
                       linear->divider[p];
    linear->slope[p] = (linear->stiffness[p] - terms.drop[s].v[0]) * linear->divider[p];
  }
  SolveStrings(cell, voltage, linear, shift);
  while (ClampSubstrings(cell, limits, state, shift, linear, clamped)) {
    SolveStrings(cell, voltage, linear, shift);
  }
  for (int s = 0; s < cell.strings; ++s) linear->current[s] = state.current[s] + shift[s];
  for (int p = 0; p < cell.substrings; ++p) {
    const int s = cell.substring[p].string;
    linear->substring_voltage[p] = linear->level[p] + shift[s] * linear->slope[p];
    linear->substring_current[p] = linear->current[s];
    if (cell.substring[p].parallel) {
      linear->substring_current[p] = linear->chain[p][0].At(linear->substring_voltage[p]);
      linear->beside_current[p] = linear->chain[p][1].At(linear->substring_voltage[p]);
      continue;
    }
    if (!cell.substring[p].bypassed) continue;
    const Dual<1, Pack>& bypass = terms.bypass[p];
    const Pack beside =
        bypass.a + (linear->substring_voltage[p] - state.substring_voltage[p]) * bypass.v[0];
    const Pack drop = terms.drop[s].a + terms.drop[s].v[0] * shift[s];
    const Pack own =
        present[p] + (linear->substring_voltage[p] - linear->mean_voltage[p] + mismatch[p] + drop) /
                         linear->stiffness[p];
    linear->substring_current[p] = Choose(clamped[p], own, linear->substring_current[p] - beside);
  }
}

// Moves the state by `factor` of a step. Returns the lanes that have converged.
Mask Move(const Cell<Pack>& cell, const StringLimits& limits, const Terms& terms,
          const Linear& linear, double factor, StringState* state) {
  Mask done = Pack(0.0) < 1.0;
  for (int g = 0; g < cell.groups; ++g) {
    const GroupPoint& point = terms.group[g];
    const Pack& current = (IsBeside(cell, g) ? linear.beside_current
                                             : linear.substring_current)[SubstringOf(cell, g)];
    const Pack missing = current - point.current.a;
    const Pack size = 1.0 + abs(current);
    const Pack u = state->u[g], newton = missing / point.current.v[0];
    const Pack step = NextVoltage(cell, limits, u, newton, point.current, size) - u;
    state->u[g] = u + factor * step;
    // The rounding error of the voltage is amplified in a bypass diode's current.
    const int p = SubstringOf(cell, g);
    Pack sum = size;
    if (cell.substring[p].bypassed)
      sum = sum + abs(terms.bypass[p].v[0] * state->substring_voltage[p]);
    done = done & ((abs(missing) < kRounding * sum) | IsShort(step, u));
    if (!cell.two_parts) continue;
    const Pack far = state->far[g], way = (factor * step + point.behind) * point.follows;
    const Pack far_step = NextVoltage(cell, limits, far, way, point.far, size) - far;
    state->far[g] = far + far_step;
    done = done & IsShort(far_step, far);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    Pack next = linear.substring_voltage[p];
    if (cell.substring[p].bypassed) {
      const double cells = cell.substring[p].cells;
      const Pack before = state->substring_voltage[p];
      const Dual<1, Pack>& bypass = terms.bypass[p];
      const Pack size =
          1.0 + abs(linear.current[cell.substring[p].string]) + abs(linear.substring_current[p]);
      next = before + StepDown(next - before, bypass, size);
      next = -1 / cells * Limited(-cells * before, -cells * next, limits.reverse, limits.bypass_vt);
      done = done & ((abs(bypass.v[0] * (next - before)) < kRounding * (1.0 + abs(bypass.a))) |
                     IsShort(cells * (next - before), cells * next));
    }
    state->substring_voltage[p] =
        state->substring_voltage[p] + factor * (next - state->substring_voltage[p]);
  }
  for (int s = 0; s < cell.strings; ++s) {
    state->current[s] = state->current[s] + factor * (linear.current[s] - state->current[s]);
  }
  return done;
}

// The lanes in which a bypass diode would carry more current than any device has. Such currents
// circulate between a substring's cells and its diode where Rs drops more than the cells give.
// Newton's method does not converge there.
Mask IsAbsurd(const Cell<Pack>& cell, const Terms& terms) {
  constexpr double kMost = 1e6;  // current scales
  Mask absurd = Pack(1.0) < 0.0;
  for (int p = 0; p < cell.substrings; ++p) {
    if (cell.substring[p].bypassed) absurd = absurd | (Pack(kMost) < abs(terms.bypass[p].a));
  }
  return absurd;
}

// Slopes at the root, by implicit differentiation of the equations of string.h.
void FindSlopes(const Cell<Pack>& cell, const Pack& voltage, const StringState& state,
                const Terms& terms, const Linear& linear, StringSlopes* slopes) {
  Pack scale[kMostGroups];  // of each string: d(total current) / d(voltage)
  for (int s = 0; s < cell.strings; ++s) {
    scale[s] = linear.string_weight[s] / linear.string_slope[s];
    slopes->by_terminal[s] = scale[s] * linear.string_weight[s];
    slopes->by_drop[s] = 0.0;
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const int s = cell.substring[p].string;
    if (cell.substring[p].parallel) {
      slopes->by_bypass[p] = scale[s] * linear.weight[p] * linear.slope[p];
      continue;
    }
    const Pack weight = scale[s] * linear.weight[p] * linear.divider[p];
    slopes->by_bypass[p] = weight * linear.stiffness[p];
    slopes->by_drop[s] = slopes->by_drop[s] + weight;
  }
  for (int g = 0; g < cell.groups; ++g) {
    const GroupPoint& point = terms.group[g];
    const int p = SubstringOf(cell, g);
    const int s = cell.substring[p].string;
    slopes->by_chain_drop[g] = 0.0;
    if (cell.substring[p].parallel) {
      // `moves`: derivative of the total current by the level of this chain.
      const Chain& chain = linear.chain[p][IsBeside(cell, g) ? 1 : 0];
      const Pack moves = 0.5 * slopes->by_bypass[p] * chain.inverse;
      const Pack share = IsBeside(cell, g) ? Pack(1.0) : ShareOf(cell, g) / linear.weight[p];
      slopes->by_current[g] = moves * share / point.current.v[0];
      slopes->by_share[g] = 0.0;
      if (!IsBeside(cell, g)) {
        slopes->by_share[g] = linear.current[s] +
                              scale[s] * (voltage - linear.substring_voltage[p]) -
                              moves / linear.weight[p] * (state.u[g] - linear.mean_voltage[p]);
      }
      if (g == GroupOfChain(cell, p, IsBeside(cell, g) ? 1 : 0)) slopes->by_chain_drop[g] = moves;
      continue;
    }
    const Pack share = scale[s] * ShareOf(cell, g) * linear.divider[p];
    slopes->by_current[g] = share / point.current.v[0];
    slopes->by_share[g] =
        linear.current[s] + scale[s] * (voltage - linear.substring_voltage[p] -
                                        linear.divider[p] * (state.u[g] - linear.mean_voltage[p]));
  }
}

void Take(const Cell<Pack>& cell, const Mask& lanes, const StringState& from, StringState* to) {
  for (int g = 0; g < cell.groups; ++g) {
    to->u[g] = Choose(lanes, from.u[g], to->u[g]);
    to->far[g] = Choose(lanes, from.far[g], to->far[g]);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    to->substring_voltage[p] = Choose(lanes, from.substring_voltage[p], to->substring_voltage[p]);
  }
  for (int s = 0; s < cell.strings; ++s) {
    to->current[s] = Choose(lanes, from.current[s], to->current[s]);
  }
}

}  // namespace

StringRoot SolveString(const EvaluationContext<Pack>& context, const Cell<Pack>& cell,
                       const StringLimits& limits, const Pack& voltage, StringState* state,
                       GiveUp give_up) {
  constexpr int kMostSteps = 150, kPatience = 30;
  Terms terms;
  Linear linear;
  constexpr double kLarge = 50;  // current scales
  bool near = false, settled_once = false;
  Mask hopeless = Pack(1.0) < 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    TermsAt(context, cell, *state, &terms);
    SolveLinear(cell, limits, voltage, *state, terms, &linear);
    // Half steps end cycles of whole steps between opposing exponentials.
    const double factor = near || k < kPatience || k > kMostSteps - kPatience ? 1 : 0.5;
    const Mask done = Move(cell, limits, terms, linear, factor, state);
    if (All(done) && factor == 1) {
      // In a steep law a small voltage step can leave a large current error: one more step is
      // needed.
      Mask large = Pack(kLarge) < abs(linear.current[0]);
      for (int s = 1; s < cell.strings; ++s)
        large = large | (Pack(kLarge) < abs(linear.current[s]));
      if (settled_once || !Any(large)) break;
      settled_once = true;
    }
    near = All(done);
    if (k != kMostSteps - kPatience) continue;
    if (give_up == GiveUp::kSlow) hopeless = !done;
    if (give_up == GiveUp::kAbsurd) hopeless = IsAbsurd(cell, terms) & (!done);
    if (Any(hopeless)) break;
    StringState bracketed;
    StartString(cell, limits, voltage, 0.0, &bracketed);
    SolveByBrackets(context, cell, limits, voltage, &bracketed);
    Take(cell, !done, bracketed, state);
  }
  StringRoot root;
  for (int g = 0; g < cell.groups; ++g) root.group[g] = terms.group[g];
  root.current = 0.0;
  for (int s = 0; s < cell.strings; ++s) {
    root.current = root.current + linear.string_weight[s] * linear.current[s];
  }
  root.current = Choose(hopeless, kUnknown, root.current);
  FindSlopes(cell, voltage, *state, terms, linear, &root.slopes);
  return root;
}

}  // namespace lyrefit
