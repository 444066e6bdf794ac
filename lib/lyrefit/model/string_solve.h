#pragma once

#include "lyrefit/base/numbers.h"
#include "lyrefit/model/string_slopes.h"

// The Newton solver of string.h for packs of one register width. Each string_*.cc compiles it once:
// all names that it gives the linker hold the type of the pack, so that no code for a newer
// processor is shared. It uses no fused multiply-add, so that all give the same bits.
namespace lyrefit {

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
