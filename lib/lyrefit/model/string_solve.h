#pragma once

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/string_step.h"

namespace lyrefit {

// Derivatives of the current of a string (string.h) at the root, for packs of one register width.

// Slopes at the root, by implicit differentiation of the equations of string.h.
template <class P>
void FindSlopes(const Cell<P>& cell, const P& voltage, const StringStateOf<P>& state,
                const Terms<P>& terms, const Linear<P>& linear, StringSlopesOf<P>* slopes) {
  P scale[kMostGroups];  // of each string: d(total current) / d(voltage)
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
    const P weight = scale[s] * linear.weight[p] * linear.divider[p];
    slopes->by_bypass[p] = weight * linear.stiffness[p];
    slopes->by_drop[s] = slopes->by_drop[s] + weight;
  }
  for (int g = 0; g < cell.groups; ++g) {
    const GroupPointOf<P>& point = terms.group[g];
    const int p = SubstringOf(cell, g);
    const int s = cell.substring[p].string;
    slopes->by_chain_drop[g] = 0.0;
    if (cell.substring[p].parallel) {
      // `moves`: derivative of the total current by the level of this chain.
      const Chain<P>& chain = linear.chain[p][IsBeside(cell, g) ? 1 : 0];
      const P moves = 0.5 * slopes->by_bypass[p] * chain.inverse;
      const P share = IsBeside(cell, g) ? P(1.0) : ShareOf(cell, g) / linear.weight[p];
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
    const P share = scale[s] * ShareOf(cell, g) * linear.divider[p];
    slopes->by_current[g] = share / point.current.v[0];
    slopes->by_share[g] =
        linear.current[s] + scale[s] * (voltage - linear.substring_voltage[p] -
                                        linear.divider[p] * (state.u[g] - linear.mean_voltage[p]));
  }
}

// Adds `factor` times the slopes of F of a cell group, at a fixed junction voltage.
template <class P>
void AddJunctionFields(const Cell<P>& cell, int group, const P& voltage, const P& factor,
                       FieldSlopesOf<P>* sum) {
  const bool alike = cell.groups == 1;
  sum->photocurrent = sum->photocurrent + (alike ? factor : factor * cell.group[group].light);
  sum->conductance = sum->conductance - factor * voltage;
  if (!alike) {
    sum->light[group] = sum->light[group] + factor * cell.photocurrent;
    sum->leak[group] = sum->leak[group] - factor * voltage;
  }
  for (int d = 0; d < cell.diodes; ++d) {
    using OfTwo = Dual<2, P>;
    const Diode<P>& diode = cell.diode[d];
    const OfTwo current =
        DiodeCurrent(OfTwo(diode.saturation, 0), OfTwo(diode.inverse_n_vt, 1), OfTwo(voltage));
    sum->saturation[d] = sum->saturation[d] + factor * current.v[0];
    sum->inverse_n_vt[d] = sum->inverse_n_vt[d] + factor * current.v[1];
  }
  if (cell.reverse == ReverseLaw::kShunt || !Any(voltage < 0.0)) return;
  using OfThree = Dual<3, P>;
  if (cell.reverse == ReverseLaw::kSoft) {
    const OfThree more = ReverseCurrent(
        ReverseTerms<OfThree>{cell.reverse, OfThree(cell.photocurrent, 0), 0.0, 0.0,
                              OfThree(cell.reverse_voltage, 1), OfThree(cell.reverse_exponent, 2)},
        OfThree(voltage));
    sum->photocurrent = sum->photocurrent + factor * more.v[0];
    sum->reverse_voltage = sum->reverse_voltage + factor * more.v[1];
    sum->reverse_exponent = sum->reverse_exponent + factor * more.v[2];
    return;
  }
  // The law is proportional to conductance times strength.
  const P strength = cell.conductance * cell.reverse_strength;
  const OfThree more = ReverseCurrent(
      ReverseTerms<OfThree>{cell.reverse, 0.0, OfThree(P(1.0), 0), 1.0,
                            OfThree(cell.reverse_voltage, 1), OfThree(cell.reverse_exponent, 2)},
      OfThree(voltage));
  sum->conductance = sum->conductance + factor * cell.reverse_strength * more.v[0];
  sum->reverse_strength = sum->reverse_strength + factor * cell.conductance * more.v[0];
  sum->reverse_voltage = sum->reverse_voltage + factor * strength * more.v[1];
  sum->reverse_exponent = sum->reverse_exponent + factor * strength * more.v[2];
}

// The same of a cell group's current, of both parts where cells have two.
template <class P>
void AddGroupFields(const Cell<P>& cell, const StringStateOf<P>& state,
                    const GroupPointOf<P>& point, int group, const P& factor,
                    FieldSlopesOf<P>* sum) {
  if (!cell.two_parts) return AddJunctionFields(cell, group, state.u[group], factor, sum);
  const P near = (1.0 - cell.far_share) * factor;
  const P far = cell.far_share * factor * point.follows;
  AddJunctionFields(cell, group, state.u[group], near, sum);
  AddJunctionFields(cell, group, state.far[group], far, sum);
  sum->far_resistance = sum->far_resistance + far * point.far.v[0] * point.far.a;
  sum->far_share = sum->far_share + factor * factor / near * (point.far.a - point.current.a);
}

template <class P>
void Clear(const Cell<P>& cell, FieldSlopesOf<P>* sum) {
  sum->photocurrent = sum->conductance = sum->resistance = sum->voltage = 0.0;
  for (int d = 0; d < cell.diodes; ++d) sum->saturation[d] = sum->inverse_n_vt[d] = 0.0;
  for (int g = 0; g < cell.groups; ++g) sum->light[g] = sum->leak[g] = sum->share[g] = 0.0;
  sum->reverse_strength = sum->reverse_voltage = sum->reverse_exponent = 0.0;
  sum->bypass = sum->bypass_ideality = sum->thermal_voltage = 0.0;
  sum->far_share = sum->far_resistance = 0.0;
}

// Slopes of the delivered current, from those by the terms of the equations.
template <class P>
void FindFieldSlopes(const Cell<P>& cell, const StringStateOf<P>& state, StringRootOf<P>* root) {
  const StringSlopesOf<P>& slopes = root->slopes;
  FieldSlopesOf<P>& fields = root->fields;
  Clear(cell, &fields);
  for (int g = 0; g < cell.groups; ++g) {
    AddGroupFields(cell, state, root->group[g], g, slopes.by_current[g], &fields);
    if (cell.groups > 1) fields.share[g] = slopes.by_share[g];
    if (cell.groups == 1 || !cell.substring[cell.group[g].substring].parallel) continue;
    fields.resistance = fields.resistance + slopes.by_chain_drop[g] * root->group[g].current.a;
  }
  for (int s = 0; s < cell.strings; ++s) {
    fields.resistance = fields.resistance + slopes.by_drop[s] * state.current[s];
    fields.voltage = fields.voltage + slopes.by_terminal[s];
  }
  for (int p = 0; p < cell.substrings; ++p) {
    if (!cell.substring[p].bypassed) continue;
    using OfThree = Dual<3, P>;
    const OfThree through = BypassCurrent(OfThree(cell.bypass, 0), OfThree(cell.bypass_ideality, 1),
                                          OfThree(cell.thermal_voltage, 2), cell.substring[p].cells,
                                          OfThree(-state.substring_voltage[p]));
    fields.bypass = fields.bypass + slopes.by_bypass[p] * through.v[0];
    fields.bypass_ideality = fields.bypass_ideality + slopes.by_bypass[p] * through.v[1];
    fields.thermal_voltage = fields.thermal_voltage + slopes.by_bypass[p] * through.v[2];
  }
}

// The Newton solver of string.h for packs of one register width. Each string_*.cc compiles it once:
// all names that it gives the linker hold the type of the pack, so that no code for a newer
// processor is shared. It uses no fused multiply-add, so that all give the same bits.

// The lanes in which a bypass diode would carry more current than any device has. Such currents
// circulate between a substring's cells and its diode where Rs drops more than the cells give.
// Newton's method does not converge there.
template <class P>
MaskOf<P> IsAbsurd(const Cell<P>& cell, const Terms<P>& terms) {
  constexpr double kMost = 1e6;  // current scales
  MaskOf<P> absurd = P(1.0) < 0.0;
  for (int p = 0; p < cell.substrings; ++p) {
    if (cell.substring[p].bypassed) absurd = absurd | (P(kMost) < abs(terms.bypass[p].a));
  }
  return absurd;
}

template <class P>
void Take(const Cell<P>& cell, const MaskOf<P>& lanes, const StringStateOf<P>& from,
          StringStateOf<P>* to) {
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

// Starts `state`, a StringState of packs, near the root: StartString, then SolveByBrackets.
void StartInBrackets(const StringEffects& effects, const void* cell, const void* limits,
                     const void* voltage, void* state);

// See SolveString of string.h.
template <class P>
void FindRoot(const StringEffects& effects, const Cell<P>& cell, const StringLimitsOf<P>& limits,
              const P& voltage, GiveUp give_up, Wanted wanted, StringStateOf<P>* state,
              StringRootOf<P>* root) {
  constexpr int kMostSteps = 150, kPatience = 30;
  Terms<P> terms;
  Linear<P> linear;
  constexpr double kLarge = 50;  // current scales
  bool near = false, settled_once = false;
  MaskOf<P> hopeless = P(1.0) < 0.0;
  for (int k = 0; k < kMostSteps; ++k) {
    TermsAt(effects, cell, *state, &terms);
    SolveLinear(cell, limits, voltage, *state, terms, &linear);
    // Half steps end cycles of whole steps between opposing exponentials.
    const double factor = near || k < kPatience || k > kMostSteps - kPatience ? 1 : 0.5;
    const MaskOf<P> done = Move(cell, limits, terms, linear, factor, state);
    if (All(done) && factor == 1) {
      // In a steep law a small voltage step can leave a large current error: one more step is
      // needed.
      MaskOf<P> large = P(kLarge) < abs(linear.current[0]);
      for (int s = 1; s < cell.strings; ++s) large = large | (P(kLarge) < abs(linear.current[s]));
      if (settled_once || !Any(large)) break;
      settled_once = true;
    }
    near = All(done);
    if (k != kMostSteps - kPatience) continue;
    if (give_up == GiveUp::kSlow) hopeless = !done;
    if (give_up == GiveUp::kAbsurd) hopeless = IsAbsurd(cell, terms) & (!done);
    if (Any(hopeless)) break;
    StringStateOf<P> bracketed;
    StartInBrackets(effects, &cell, &limits, &voltage, &bracketed);
    Take(cell, !done, bracketed, state);
  }
  for (int g = 0; g < cell.groups; ++g) root->group[g] = terms.group[g];
  root->current = 0.0;
  for (int s = 0; s < cell.strings; ++s) {
    root->current = root->current + linear.string_weight[s] * linear.current[s];
  }
  root->current = Choose(hopeless, kUnknown, root->current);
  if (wanted == Wanted::kCurrent) return;
  FindSlopes(cell, voltage, *state, terms, linear, &root->slopes);
  FindFieldSlopes(cell, *state, root);
  if (wanted == Wanted::kSlopes) return;
  Clear(cell, &root->first_group);
  AddGroupFields(cell, *state, root->group[0], 0, P(1.0), &root->first_group);
}

// FindRoot for arguments in memory, see StringKernel. Packs of all widths are alike there, and no
// object file knows those of two widths.
template <class P>
void FindRootInMemory(const StringEffects& effects, const void* cell, const void* limits,
                      const void* voltage, GiveUp give_up, Wanted wanted, void* state, void* root) {
  // NOLINTNEXTLINE(misc-redundant-expression): P is Pack itself in one of the widths
  static_assert(sizeof(P) == sizeof(Pack) && alignof(P) == alignof(Pack));
  static_assert(sizeof(Cell<P>) == sizeof(Cell<Pack>) &&
                sizeof(StringStateOf<P>) == sizeof(StringState) &&
                sizeof(StringRootOf<P>) == sizeof(StringRoot));
  FindRoot(effects, *static_cast<const Cell<P>*>(cell),
           *static_cast<const StringLimitsOf<P>*>(limits), *static_cast<const P*>(voltage), give_up,
           wanted, static_cast<StringStateOf<P>*>(state), static_cast<StringRootOf<P>*>(root));
}

// The same with all its calls inlined: a tenth less time where a pack is one or two registers.
template <class P>
[[gnu::flatten]] void FindRootInOneGo(const StringEffects& effects, const void* cell,
                                      const void* limits, const void* voltage, GiveUp give_up,
                                      Wanted wanted, void* state, void* root) {
  FindRootInMemory<P>(effects, cell, limits, voltage, give_up, wanted, state, root);
}

// AddSlopes for duals in memory.
template <class P>
void AddSlopesInMemory(const SlopeTerm* terms, int count, int size, void* sum) {
  P* const derivative = static_cast<P*>(sum) + 1;
  for (int k = 0; k < size; ++k) {
    P added = derivative[k];
    for (int t = 0; t < count; ++t) {
      const void* const slope = terms[t].slope;
      added = added + *static_cast<const P*>(slope) * static_cast<const P*>(terms[t].by)[1 + k];
    }
    derivative[k] = added;
  }
}

}  // namespace lyrefit
