#pragma once

#include <vector>

#include "lyrefit/model/cell.h"

// Solves unlike cells in series, and such strings in parallel: finds the current at a given
// voltage. A string of identical cells has one cell group.
//
// Each cell group g has a junction voltage u that determines its current F(u). All cell groups of a
// substring p carry the same current J. The bypass diode in parallel carries B:
//
//   F_g(u_g) = J_p,   U_p = mean of u_g - D(I),   J_p + B(-U_p) = I,   sum of w_p U_p = W V
//
// If a substring is two chains in parallel (half-cut), each with its own drop:
//
//   F_g(u_g) = J_p,   F_b(u_b) = K_p,   U_p = mean of u_g - D(J_p) = u_b - D(K_p),
//   (J_p + K_p) / 2 + B(-U_p) = I
//
// w and W are the shares of the substring and of the string in all cells. Newton's method solves
// all equations at once. The system is a tree, so a step costs one evaluation of each cell group
// and a few sums. Exponentials are limited as in circuit simulators (Nagel 1975, SPICE2): beyond
// the voltage at which the junction carries all the current, a step is replaced by its logarithm.
namespace lyrefit {

// State of the iteration for eight readings: junction voltages of the cell groups, voltages of the
// substrings, currents of the strings. In cells of two parts `u` is the near part's and `far` the
// far part's voltage. Voltages and currents of a string are scaled as if all cells were in that string.
template <class P>
struct StringStateOf {
  P u[kMostGroups];
  P far[kMostGroups];
  P substring_voltage[kMostGroups];
  P current[kMostGroups];
  int groups = 0;  // numbers of valid entries
  int substrings = 0;
  int strings = 0;

  bool Fits(const Cell<P>& cell) const {
    return groups == cell.groups && substrings == cell.substrings && strings == cell.strings;
  }
};

// Voltages at which exponentials dominate: steps beyond them are logarithmic.
template <class P>
struct StringLimitsOf {
  P voltage;  // of an unknown
  P n_vt;
  P reverse;  // of a bypass diode, at its own voltage
  P bypass_vt;
};

// Current of a cell group at its junction voltage. With two parts, I = (1 - a) F(u) + a F(f) and
// f = u + R F(f). The far part is linearised, so that the current depends on u alone.
template <class P>
struct GroupPointOf {
  Dual<1, P> current;  // with its slope by u
  Dual<1, P> far;      // two parts: F(f), with its slope
  P follows;           // two parts: df/du
  P behind;            // two parts: residual of the equation for f
};

// Derivatives of the delivered current by each term of the equations, at the root.
template <class P>
struct StringSlopesOf {
  P by_current[kMostGroups];  // F of each cell group
  P by_share[kMostGroups];
  P by_bypass[kMostGroups];      // B of each substring
  P by_drop[kMostGroups];        // D of each string
  P by_chain_drop[kMostGroups];  // D of the group's chain (parallel), else 0
  P by_terminal[kMostGroups];    // V, in each string
};

// Derivatives of a current by the fields of a cell, without those by the terms of effects.
template <class P>
struct FieldSlopesOf {
  P photocurrent;
  P conductance;
  P resistance;
  P voltage;  // at the terminals
  P saturation[Cell<P>::kMostDiodes];
  P inverse_n_vt[Cell<P>::kMostDiodes];
  P light[kMostGroups];
  P leak[kMostGroups];
  P share[kMostGroups];
  P reverse_strength;
  P reverse_voltage;
  P reverse_exponent;
  P bypass;
  P bypass_ideality;
  P thermal_voltage;  // of bypass diodes
  P far_share;
  P far_resistance;
};

// What is wanted beside the current.
enum class Wanted {
  kCurrent,
  kSlopes,         // StringRoot::slopes and `fields`
  kJunctionSlopes  // `first_group` as well
};

template <class P>
struct StringRootOf {
  P current;  // delivered by all strings
  GroupPointOf<P> group[kMostGroups];
  StringSlopesOf<P> slopes;
  FieldSlopesOf<P> fields;       // of the delivered current
  FieldSlopesOf<P> first_group;  // of the first group's current, at a fixed junction voltage
};

using StringState = StringStateOf<Pack>;
using StringLimits = StringLimitsOf<Pack>;
using GroupPoint = GroupPointOf<Pack>;
using StringSlopes = StringSlopesOf<Pack>;
using FieldSlopes = FieldSlopesOf<Pack>;
using StringRoot = StringRootOf<Pack>;

StringLimits LimitsOf(const Cell<Pack>& cell);

// Start state from a guess `current`.
void StartString(const Cell<Pack>& cell, const StringLimits& limits, const Pack& voltage,
                 const Pack& current, StringState* state);

// Law and parameters of a string whose effects add terms to the junction or the series drop. Their
// stages are for packs of every processor.
struct StringEffects {
  const EvaluationContext<Pack>* context;
  bool junction;
  bool series;
};
StringEffects EffectsOf(const EvaluationContext<Pack>& context);

// Solves the string at `voltage` per cell from `state`, which is moved to the root, with the widest
// registers of this processor. The current is NaN in lanes where the iteration was given up.
void SolveString(const StringEffects& effects, const Cell<Pack>& cell, const StringLimits& limits,
                 const Pack& voltage, GiveUp give_up, Wanted wanted, StringState* state,
                 StringRoot* root);

// A slope and what it is by: a dual of packs, whose derivatives follow its value.
struct SlopeTerm {
  const Pack* slope;
  const void* by;
};
// Adds the product of each slope and the first `size` derivatives of its dual to those of the dual
// `sum`, in the order of the terms.
void AddSlopes(const std::vector<SlopeTerm>& terms, int size, void* sum);

// A solver for registers of one width: string_solve.h in the types of a processor. All give the same
// bits. They are SolveString and AddSlopes for packs as they are in memory.
struct StringKernel {
  const char* name;  // "portable", "avx2", "avx512"
  void (*solve)(const StringEffects& effects, const void* cell, const void* limits,
                const void* voltage, GiveUp give_up, Wanted wanted, void* state, void* root);
  void (*add_slopes)(const SlopeTerm* terms, int count, int size, void* sum);
};
// Every one that this processor can run, slowest ("portable") first.
const std::vector<StringKernel>& StringKernels();

}  // namespace lyrefit
