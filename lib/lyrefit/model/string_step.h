#pragma once

#include "lyrefit/model/string_cell_group.h"

// One step of the Newton solver of string.h, for packs of one register width.
namespace lyrefit {

// All terms of the equations at a state.
template <class P>
struct Terms {
  GroupPointOf<P> group[kMostGroups];
  Dual<1, P> bypass[kMostGroups];         // of each substring, slope by its voltage
  Dual<1, P> drop[kMostGroups];           // of each string
  Dual<1, P> chain_drop[kMostGroups][2];  // of both chains of a parallel substring
};

// The cell group whose current is that of a chain of a parallel substring.
template <class P>
int GroupOfChain(const Cell<P>& cell, int substring, int chain) {
  int g = 0;
  while (cell.group[g].substring != substring || cell.group[g].beside != (chain == 1)) ++g;
  return g;
}

template <class P>
void TermsAt(const StringEffects& effects, const Cell<P>& cell, const StringStateOf<P>& state,
             Terms<P>* terms) {
  for (int g = 0; g < cell.groups; ++g) terms->group[g] = PointOf(effects, cell, g, state);
  for (int s = 0; s < cell.strings; ++s) {
    terms->drop[s] = SeriesDrop(effects, cell, state.current[s]);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    if (!cell.substring[p].bypassed) continue;
    terms->bypass[p] =
        BypassCurrent(cell, cell.substring[p].cells, -Dual<1, P>(state.substring_voltage[p], 0));
  }
  for (int p = 0; p < cell.substrings; ++p) {
    for (int c = 0; cell.substring[p].parallel && c < 2; ++c) {
      const P& current = terms->group[GroupOfChain(cell, p, c)].current.a;
      terms->chain_drop[p][c] = SeriesDrop(effects, cell, current);
    }
  }
}

// Linearised current of a chain of a parallel substring: present + (U - level) x inverse.
template <class P>
struct Chain {
  P present;
  P level;
  P inverse;
  P At(const P& voltage) const { return present + (voltage - level) * inverse; }
};

// Solution of the linear system at a state. Identical cells are one cell group in one substring.
template <class P>
struct Linear {
  P weight[kMostGroups];        // of each substring
  P mean_voltage[kMostGroups];  // of the cells of each substring
  P stiffness[kMostGroups];     // mean du/dF of each substring
  P divider[kMostGroups];
  P level[kMostGroups];  // substring: U = level + slope x (I - present I)
  P slope[kMostGroups];
  P string_weight[kMostGroups];
  P string_slope[kMostGroups];
  P current[kMostGroups];            // of each string, after the step
  P substring_current[kMostGroups];  // of each substring's cells, after the step
  P substring_voltage[kMostGroups];
  Chain<P> chain[kMostGroups][2];
  P beside_current[kMostGroups];  // of the second chain, after the step
};

// Means over the cell groups of each substring, and the present current of its cells.
template <class P>
void SumGroups(const Cell<P>& cell, const StringStateOf<P>& state, const Terms<P>& terms,
               Linear<P>* linear, P* present, P* mismatch) {
  bool seen[kMostGroups] = {};
  for (int p = 0; p < cell.substrings; ++p) {
    linear->weight[p] = linear->mean_voltage[p] = linear->stiffness[p] = mismatch[p] = 0.0;
  }
  for (int g = 0; g < cell.groups; ++g) {
    if (IsBeside(cell, g)) continue;
    const GroupPointOf<P>& point = terms.group[g];
    const int p = SubstringOf(cell, g);
    const P share = ShareOf(cell, g);
    const P slope = share / point.current.v[0];
    if (!seen[p]) present[p] = point.current.a;
    seen[p] = true;
    linear->weight[p] = linear->weight[p] + share;
    linear->mean_voltage[p] = linear->mean_voltage[p] + share * state.u[g];
    linear->stiffness[p] = linear->stiffness[p] + slope;
    mismatch[p] = mismatch[p] + (point.current.a - present[p]) * slope;
  }
  for (int p = 0; p < cell.substrings; ++p) {
    const P inverse = 1.0 / linear->weight[p];
    linear->mean_voltage[p] = linear->mean_voltage[p] * inverse;
    linear->stiffness[p] = linear->stiffness[p] * inverse;
    mismatch[p] = mismatch[p] * inverse;
  }
}

// Level and slope of a substring of two chains, as functions of their total current.
template <class P>
void SolvePair(const Cell<P>& cell, int p, const StringStateOf<P>& state, const Terms<P>& terms,
               const P& present, const P& mismatch, Linear<P>* linear) {
  const int g = GroupOfChain(cell, p, 1);
  const Dual<1, P>& beside = terms.group[g].current;
  const Dual<1, P>*drop = terms.chain_drop[p], &bypass = terms.bypass[p];
  Chain<P>* chain = linear->chain[p];
  chain[0] = {present, linear->mean_voltage[p] - mismatch - drop[0].a,
              1.0 / (linear->stiffness[p] - drop[0].v[0])};
  chain[1] = {beside.a, state.u[g] - drop[1].a, 1.0 / (1.0 / beside.v[0] - drop[1].v[0])};
  P slope = 0.5 * (chain[0].inverse + chain[1].inverse);
  P rest = state.current[cell.substring[p].string] - 0.5 * (chain[0].At(0.0) + chain[1].At(0.0));
  if (cell.substring[p].bypassed) {
    slope = slope + bypass.v[0];
    rest = rest - bypass.a + bypass.v[0] * state.substring_voltage[p];
  }
  linear->slope[p] = 1.0 / slope;
  linear->level[p] = rest * linear->slope[p];
}

// Changes of the string currents, given level and slope of every substring.
template <class P>
void SolveStrings(const Cell<P>& cell, const P& voltage, Linear<P>* linear, P* shift) {
  P level[kMostGroups];
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
template <class P>
bool ClampSubstrings(const Cell<P>& cell, const StringLimitsOf<P>& limits,
                     const StringStateOf<P>& state, const P* shift, Linear<P>* linear,
                     MaskOf<P>* clamped) {
  bool any = false;
  for (int p = 0; p < cell.substrings; ++p) {
    if (!cell.substring[p].bypassed) continue;
    const double cells = cell.substring[p].cells;
    const P on = -limits.reverse / cells, far = on - 3.0 / cells * limits.bypass_vt;
    const P next = linear->level[p] + shift[cell.substring[p].string] * linear->slope[p];
    const MaskOf<P> below = (next < far) & (on < state.substring_voltage[p]) & (!clamped[p]);
    if (!Any(below)) continue;
    any = true;
    clamped[p] = clamped[p] | below;
    linear->level[p] = Choose(below, on, linear->level[p]);
    linear->slope[p] = Choose(below, -limits.bypass_vt / cells, linear->slope[p]);
  }
  return any;
}

// SolveLinear for identical cells.
template <class P>
void SolveAlike(const P& voltage, const StringStateOf<P>& state, const Terms<P>& terms,
                Linear<P>* linear) {
  const Dual<1, P>&current = terms.group[0].current, &drop = terms.drop[0];
  linear->weight[0] = linear->divider[0] = linear->string_weight[0] = 1.0;
  linear->mean_voltage[0] = state.u[0];
  linear->stiffness[0] = 1.0 / current.v[0];
  linear->level[0] = state.u[0] + (state.current[0] - current.a) * linear->stiffness[0] - drop.a;
  linear->slope[0] = linear->string_slope[0] = linear->stiffness[0] - drop.v[0];
  const P shift = (voltage - linear->level[0]) / linear->slope[0];
  linear->current[0] = linear->substring_current[0] = state.current[0] + shift;
  linear->substring_voltage[0] = linear->level[0] + shift * linear->slope[0];
}

template <class P>
void SolveLinear(const Cell<P>& cell, const StringLimitsOf<P>& limits, const P& voltage,
                 const StringStateOf<P>& state, const Terms<P>& terms, Linear<P>* linear) {
  if (cell.groups == 1) return SolveAlike(voltage, state, terms, linear);
  P present[kMostGroups], mismatch[kMostGroups], shift[kMostGroups];
  MaskOf<P> clamped[kMostGroups];
  SumGroups(cell, state, terms, linear, present, mismatch);
  for (int p = 0; p < cell.substrings; ++p) {
    const int s = cell.substring[p].string;
    P into_cells = state.current[s] - present[p];
    clamped[p] = P(1.0) < 0.0;
    linear->divider[p] = 1.0;
    if (cell.substring[p].parallel) {
      SolvePair(cell, p, state, terms, present[p], mismatch[p], linear);
      continue;
    }
    if (cell.substring[p].bypassed) {
      const Dual<1, P>& bypass = terms.bypass[p];
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
    const Dual<1, P>& bypass = terms.bypass[p];
    const P beside =
        bypass.a + (linear->substring_voltage[p] - state.substring_voltage[p]) * bypass.v[0];
    const P drop = terms.drop[s].a + terms.drop[s].v[0] * shift[s];
    const P own =
        present[p] + (linear->substring_voltage[p] - linear->mean_voltage[p] + mismatch[p] + drop) /
                         linear->stiffness[p];
    linear->substring_current[p] = Choose(clamped[p], own, linear->substring_current[p] - beside);
  }
}

// Moves the state by `factor` of a step. Returns the lanes that have converged.
template <class P>
MaskOf<P> Move(const Cell<P>& cell, const StringLimitsOf<P>& limits, const Terms<P>& terms,
               const Linear<P>& linear, double factor, StringStateOf<P>* state) {
  MaskOf<P> done = P(0.0) < 1.0;
  for (int g = 0; g < cell.groups; ++g) {
    const GroupPointOf<P>& point = terms.group[g];
    const P& current = (IsBeside(cell, g) ? linear.beside_current
                                          : linear.substring_current)[SubstringOf(cell, g)];
    const P missing = current - point.current.a;
    const P size = 1.0 + abs(current);
    const P u = state->u[g], newton = missing / point.current.v[0];
    const P step = NextVoltage(cell, limits, u, newton, point.current, size) - u;
    state->u[g] = u + factor * step;
    // The rounding error of the voltage is amplified in a bypass diode's current.
    const int p = SubstringOf(cell, g);
    P sum = size;
    if (cell.substring[p].bypassed)
      sum = sum + abs(terms.bypass[p].v[0] * state->substring_voltage[p]);
    done = done & ((abs(missing) < kRounding * sum) | IsShort(step, u));
    if (!cell.two_parts) continue;
    const P far = state->far[g], way = (factor * step + point.behind) * point.follows;
    const P far_step = NextVoltage(cell, limits, far, way, point.far, size) - far;
    state->far[g] = far + far_step;
    done = done & IsShort(far_step, far);
  }
  for (int p = 0; p < cell.substrings; ++p) {
    P next = linear.substring_voltage[p];
    if (cell.substring[p].bypassed) {
      const double cells = cell.substring[p].cells;
      const P before = state->substring_voltage[p];
      const Dual<1, P>& bypass = terms.bypass[p];
      const P size =
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

}  // namespace lyrefit
